#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tables and rules for the results file of public_disks.py.

The acceptance rules: every run valid (no problem noted); exit 0, except at most two exits 4 with
status `stalled`; energy by verify.py at most 0.2 % above the reference (5 % where the reference is
path dependent; demosthenes pinned is only reported); degree 2 not above degree 1 and degree 3 at most
0.1 % above degree 2. Energies below the reference by more than the tolerance are better minima of a
verified map: they are listed and break no rule.

Sample runs:
  bench/disks_summary.py /tmp/disks.json           # the same as public_disks.py --render
"""
import sys
from collections import Counter

import common

STALLED_ALLOWED = 2
TOLERANCE = {False: 0.002, True: 0.05}            # relative energy above the reference, by its flag path_dependent
LIMITS = {(1, 2): 1 + 1e-6, (2, 3): 1.001}        # E(upper) <= limit * E(lower)
REPORTED_LIMITS = {(3, 4): 1.001, (4, 5): 1.001}


def name_of(entry):
    return '%s %s %d' % (entry['mesh'], entry['boundary'], entry['degree'])


# ------------------------------------------------------------------ tables
def deviation(entry):
    """Returns the relative deviation of the verified energy from the reference; None if one is missing."""
    if entry['reference'] is None or entry.get('E_SD') is None:
        return None
    return entry['E_SD'] / entry['reference']['E'] - 1


def percent(value):
    return common.cell(None if value is None else 100 * value, '%+.3f')


def energy_cell(entry):
    text = common.cell(entry.get('E_SD'), '%.6g')
    if entry['exit'] != 0:
        text += ' (exit %s, %s)' % (entry['exit'], entry['status'])
    return text + (' **not valid**' if entry['problems'] else '')


def reference_cell(entry):
    target = entry['reference']
    return '-' if target is None else '%.6g%s' % (target['E'], '~' if target['path_dependent'] else '')


def cells(entry):
    if entry is None:
        return ['', '', '', '']
    return [energy_cell(entry), reference_cell(entry), percent(deviation(entry)), entry['iterations']]


def mesh_order(mesh):
    model, size = mesh.rsplit('_', 1)
    return model, int(size)


def table(entries, boundary):
    """Returns the lines of the table of one boundary: a row for each mesh, four columns for each degree."""
    chosen = {(e['mesh'], e['degree']): e for e in entries.values() if e['boundary'] == boundary}
    degrees = sorted({degree for _, degree in chosen})
    header = ['mesh'] + [text % n for n in degrees for text in ('E(%d)', 'ref(%d)', '%%(%d)', 'it(%d)')]
    rows = [[mesh] + [text for n in degrees for text in cells(chosen.get((mesh, n)))]
            for mesh in sorted({mesh for mesh, _ in chosen}, key=mesh_order)]
    return ['', '## Boundary: ' + boundary, ''] + common.markdown_table(header, rows) if rows else []


# ------------------------------------------------------------------ rules
def only_reported(entry):
    return entry['boundary'] == 'pinned' and entry['mesh'].startswith('demosthenes')


def deviations(entries, sign):
    """Returns entries whose energy is off by more than the tolerance, above (sign +1) or below the reference (-1)."""
    return [entry for entry in entries.values()
            if deviation(entry) is not None
            and sign * deviation(entry) > TOLERANCE[entry['reference']['path_dependent']]]


def rises(entries, limits):
    """Returns (name, ratio) of runs whose value rises with the degree by more than the limit."""
    found = []
    values = {(e['mesh'], e['boundary'], e['degree']): e['value'] for e in entries.values()}
    for (mesh, boundary, upper), value in sorted(values.items(), key=lambda item: item[0]):
        before = values.get((mesh, boundary, upper - 1))
        limit = limits.get((upper - 1, upper))
        if limit and value is not None and before is not None and value > limit * before:
            found.append('%s %s: E(%d) = E(%d) x (1 %+.2e)' % (mesh, boundary, upper, upper - 1,
                                                               value / before - 1))
    return found


def describe_exit(entry):
    return '%s: exit %s, %s, E %s, %s' % (name_of(entry), entry['exit'], entry['status'],
                                          common.cell(entry.get('E_SD'), '%.6g'), entry['stderr'])


def describe_deviation(entry):
    return '%s: %s %% (E %.6g, reference %.6g%s)%s' % (
        name_of(entry), percent(deviation(entry)), entry['E_SD'], entry['reference']['E'],
        ', path dependent' if entry['reference']['path_dependent'] else '',
        ' - only reported' if only_reported(entry) else '')


def stalled(entry):
    return entry['exit'] == 4 and entry['status'] == 'stalled'


def broken_rules(entries):
    """Returns one line for each acceptance rule that does not hold."""
    runs = list(entries.values())
    above = [entry for entry in deviations(entries, +1) if not only_reported(entry)]
    counts = {'runs with problems': sum(bool(entry['problems']) for entry in runs),
              'runs that end neither with exit 0 nor stalled':
                  sum(entry['exit'] != 0 and not stalled(entry) for entry in runs),
              'energies above the tolerance': len(above),
              'energies that rise with the degree': len(rises(entries, LIMITS))}
    broken = ['%d %s' % (count, rule) for rule, count in counts.items() if count]
    stuck = sum(stalled(entry) for entry in runs)
    if stuck > STALLED_ALLOWED:
        broken.append('%d stalled runs, %d allowed' % (stuck, STALLED_ALLOWED))
    return broken if runs else ['no runs']


# ------------------------------------------------------------------ summary
def listing(title, lines):
    return ['', '%s: %d' % (title, len(lines))] + ['* ' + line for line in lines]


def own_tolerance(entries):
    """Returns how many energies exceed the reference by more than the tolerance in results.json."""
    return sum(deviation(entry) is not None and deviation(entry) > entry['reference']['tolerance']
               for entry in entries.values())


def value_gap(entries):
    """Returns the largest difference between the report's value and verify.py's energy, and its run."""
    gaps = [(abs(entry['value'] / entry['E_SD'] - 1), name_of(entry)) for entry in entries.values()
            if entry['value'] is not None and entry.get('E_SD') is not None]
    return 'none' if not gaps else '%.1e (%s)' % max(gaps)


def count_where(entries, field):
    return sum(bool(entry.get(field)) for entry in entries.values())


def overview(entries):
    codes = Counter(str(entry['exit']) for entry in entries.values())
    compared = [entry for entry in entries.values() if deviation(entry) is not None]
    return ['* runs: %d, %.0f s of majorant' % (len(entries), sum(e['seconds'] for e in entries.values())),
            '* exit codes: ' + ', '.join('%s: %d' % item for item in sorted(codes.items())),
            '* compared with a reference: %d' % len(compared),
            '* further above the reference than its own tolerance: %d' % own_tolerance(entries),
            '* largest relative difference of value and verified energy: ' + value_gap(entries),
            '* with boundary sector sums above 2 pi: %d' % count_where(entries, 'boundary_over_2pi'),
            '* with boundary crossings: %d' % count_where(entries, 'crossings')]


def summary(entries):
    runs = entries.values()
    lines = ['', '## Summary', ''] + overview(entries)
    lines += listing('Problems', ['%s: %s' % (name_of(entry), '; '.join(entry['problems']))
                                  for entry in runs if entry['problems']])
    lines += listing('Not exit 0', [describe_exit(entry) for entry in runs if entry['exit'] != 0])
    lines += listing('Above the tolerance', [describe_deviation(e) for e in deviations(entries, +1)])
    lines += listing('Better than the reference by more than the tolerance',
                     [describe_deviation(e) for e in deviations(entries, -1)])
    lines += listing('Rises with the degree', rises(entries, LIMITS))
    lines += listing('Rises by more than 0.1 % from degree 3 to 4 or 4 to 5 (only reported)',
                     rises(entries, REPORTED_LIMITS))
    return lines


def show(entries):
    """Prints all tables and rules. Returns the exit code."""
    lines = ['# Public disks: verified symmetric Dirichlet energy', '',
             'E: energy by verify.py, ref: reference (~ path dependent), %: deviation, it: iterations.']
    for boundary in ('free', 'fixed', 'pinned'):
        lines += table(entries, boundary)
    broken = broken_rules(entries)
    lines += summary(entries)
    lines += ['', 'Acceptance: ' + ('holds' if not broken else 'does not hold: ' + '; '.join(broken))]
    print('\n'.join(lines))
    return 1 if broken else 0


if __name__ == '__main__':
    if len(sys.argv) != 2 or sys.argv[1].startswith('-'):
        sys.exit(__doc__)
    sys.exit(show(common.load_strict(sys.argv[1])))
