#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the verdicts of `majorant check` on thousands of generated files with the truth.

Files of many kinds, good and broken (campaign_kinds.py, campaign_damage.py), and files that the program wrote
itself, whole and then damaged. The truth is known by construction, or is the verdict of the independent
checker in tests/checker; if both exist they must agree. It never comes from the library. A verdict is wrong
if it is the opposite of the truth, or is missing. At most 2 % of valid files may be undecided, and none that
the program wrote.

If the decimals of an OBJ and the doubles that readers make of them have different truths, the file is counted
apart.

Prints a Markdown table; exit code 0 exactly if all conditions hold. Wrong files are kept with --keep.

Sample runs:
  tests/campaigns/check_campaign.py
  tests/campaigns/check_campaign.py --count 300 --seed 2 --keep wrong
"""
import argparse
import itertools
import multiprocessing
import os
import random
import shutil
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import campaign_damage as damages
import campaign_kinds as kinds
import campaign_maps as maps
sys.path.append(str(Path(__file__).resolve().parents[2] / 'bench'))
import check_map  # noqa: E402
import common  # noqa: E402
from campaign_kinds import DIFFERS, INVALID, UNREADABLE, VALID, Case  # noqa: E402
from vtu_file import Unreadable  # noqa: E402

MOST_UNDECIDED = 0.02       # largest fraction of undecided verdicts among valid files
WRITTEN = 'written: '       # prefix of the kinds of files that the program wrote
WORDS = {'ok': VALID, 'bad': INVALID}
UNDECIDED = 'undecided'
KINDS = {**kinds.KINDS, **damages.KINDS}
RUNS_WEIGHT = 420           # weight of runs of the program among the weights of KINDS
FLAGS = ('--cuts', '--seamless', '--certify')  # flags of check, some of which an older program may lack


class Result:
    """The result of a file: kind, case without its bytes, verdicts of the checker and the program."""

    def __init__(self, kind, case, checker, verdict, seconds):
        self.kind, self.truth, self.checker, self.verdict = kind, case.truth, checker, verdict
        self.is_closed, self.degree, self.faces = case.is_closed, case.degree, case.faces
        self.extension, self.seconds, self.name = case.extension, seconds, case.name
        expected = case.unseen or {VALID: 'ok', INVALID: 'bad', UNREADABLE: 'unreadable',
                                   DIFFERS: 'bad', None: checker}[case.truth]
        self.is_disputed = checker not in (expected, UNDECIDED)
        if self.truth is None:
            self.truth = WORDS.get(checker, UNREADABLE if checker == 'unreadable' else None)

    def outcome(self):
        if self.truth in (None, DIFFERS):
            return 'apart'
        return 'right' if self.verdict == self.truth else \
            UNDECIDED if self.verdict == UNDECIDED else 'wrong'


# ------------------------------------------------------------------ files that the program writes
def mesh_to_map(rng):
    """Returns (verb, map whose surface is the mesh)."""
    kind = rng.randrange(6)
    if kind < 3:
        return 'parametrize', maps.grid(*kinds.shape(rng), 1, rng)
    if kind == 3:
        return 'seamless', maps.ring(rng.randrange(6, 20), rng.randrange(1, 8), 1, rng)
    if kind == 4:
        return 'seamless', maps.cube(rng.randrange(1, 6), 1, rng, rng.choice((5, 6)))
    return 'seamless', maps.torus(rng.randrange(4, 12), rng.randrange(4, 8), 1, rng)


def run_program(rng, program, folder):
    """Returns the cases of files that a random run and `convert` wrote, and of their damaged copies; or the
    message of a run that wrote nothing."""
    verb, made = mesh_to_map(rng)
    (folder / 'mesh.obj').write_bytes(made.mesh)
    flags = ['--degree', rng.choice((1, 2, 3, 4)), '--threads', 1,
             '--max-iterations', rng.choice((1, 3, 10, 30)) if len(made.uv) < 300 else 1]
    flags += ['--normalize'] if rng.random() < 0.4 else []
    flags += ['--boundary', 'fixed'] if verb == 'parametrize' and rng.random() < 0.2 else []
    is_bijective = verb == 'parametrize' and 'fixed' not in flags and rng.random() < 0.3
    flags += ['--bijective'] if is_bijective else []
    names = rng.sample(['a.vtu', 'a.obj'], 2)
    done = common.parametrize(program, folder / 'mesh.obj', [folder / n for n in names], *flags,
                              verb=verb)
    if done.code not in (0, 4):
        return ' '.join(map(str, [verb, *flags])) + ': ' + done.stderr.strip()
    found = [(WRITTEN + verb, name) for name in names]
    if len(made.uv) < 300:
        names = ['b.obj', 'b.vtu']
        done = common.parametrize(program, folder / 'a.vtu', [folder / n for n in names],
                                  '--refine', rng.randrange(1, 4), verb='convert')
        if done.code != 0:
            return 'convert: ' + done.stderr.strip()
        found += [(WRITTEN + 'convert', name) for name in names]
    cases = []
    for kind, name in found:
        read = maps.read_obj if name.endswith('.obj') else maps.read_vtu
        data = (folder / name).read_bytes()
        result = read(data, made.mesh, made.is_closed)
        options = {'surface': made.mesh, 'certify': is_bijective, 'seamless': verb == 'seamless'}
        cases.append((kind, Case(result, data, Path(name).suffix, VALID, **options)))
    options['certify'] = False
    return cases + [damage(rng, *rng.choice(cases)[1:], read_again(made), options)
                    for _ in range(2)]


def read_again(made):
    return {'.obj': lambda data: maps.read_obj(data, made.mesh, made.is_closed),
            '.vtu': lambda data: maps.read_vtu(data, made.mesh, made.is_closed)}


def damage(rng, case, readers, options):
    """Returns the file with one damage, with a wrong claim, or without its claims."""
    result = readers[case.extension](case.data)
    seamless = {'seamless': True} if options['seamless'] else {}
    method = rng.random()
    if method < 0.2 and result.claims:
        truth, more = damages.lie(result, rng, seamless)
        return 'written, a claim changed', Case(result, result.vtu(), '.vtu', truth,
                                                **{**options, **more})
    if method < 0.4:
        result.claims = None
        return 'written, claims taken away', Case(result, write_as(case, result), case.extension,
                                                  VALID, **options)
    choices = [damages.tear, damages.mirror, damages.bulge]
    if case.extension == '.vtu':  # the faces of an OBJ may be parts of the surface's
        choices += [damages.shift, damages.double]
    truth, more = rng.choice(choices)(result, rng, seamless)
    more.pop('extension', None)
    if truth != INVALID or method < 0.7:  # the claims are wrong even if the map is still valid
        result.claims = None
    truth = None if truth == VALID else truth
    more = {'cuts': 'none', **seamless, **more}
    if 'surface' in more or truth == INVALID and rng.random() < 0.5:
        more['surface'] = options['surface']
    return 'written, then damaged', Case(result, write_as(case, result), case.extension, truth,
                                         **more)


def write_as(case, result):
    return result.obj() if case.extension == '.obj' else result.vtu()


# ------------------------------------------------------------------ judges
def ask_checker(path, case, surface):
    words = [str(path), '--cuts', case.cut_rule()]
    words += ['--surface', str(surface)] if surface else []
    words += ['--seamless'] * case.seamless_at_all() + ['--overlap'] * case.certify
    try:
        return check_map.check(str(path), check_map.parse(words)).verdict
    except Unreadable:
        return 'unreadable'


def ask_program(path, case, surface, program):
    """Returns (verdict, seconds). The verdict is a truth, undecided, or a description of the failure."""
    report = path.with_suffix('.json')
    words = ['--surface', surface] if surface else []
    words += ['--cuts', case.cuts] if case.cuts else []
    words += ['--seamless'] * case.seamless + ['--certify'] * case.certify
    lacking = [flag for flag in FLAGS if flag not in program.knows]
    for flag in lacking:
        if flag in words:
            del words[words.index(flag):words.index(flag) + (2 if flag == '--cuts' else 1)]
    command = [program.binary.resolve(), 'check', path, *words, '--report', report, '--threads', 1]
    done = common.run(command, program.timeout)
    if done.code == 2:
        return UNREADABLE, done.seconds
    status = common.load_report(report)[0].get('status')
    if (done.code, status) not in ((0, VALID), (5, INVALID), (5, UNDECIDED)):
        status = 'exit %s, status %s' % (done.code, status)
    return status, done.seconds


def judge(kind, case, name, program, folder):
    path, surface = folder / (name + case.extension), None
    path.write_bytes(case.data)
    if case.surface:
        surface = folder / 'surface.obj'
        surface.write_bytes(case.surface)
    verdict, seconds = ask_program(path, case, surface, program)
    case.name = path.name
    result = Result(kind, case, ask_checker(path, case, surface), verdict, seconds)
    if program.keep and (result.outcome() == 'wrong' or result.is_disputed):
        program.keep.mkdir(exist_ok=True)
        shutil.copy(path, program.keep)
        if surface:
            shutil.copy(surface, program.keep / (name + '_surface.obj'))
        (program.keep / (name + '.txt')).write_text(
            '%s\ntruth %s, checker %s, program %s\ncuts %s (%s) seamless %s certify %s surface %s\n'
            % (kind, result.truth, result.checker, verdict, case.cuts, case.cut_rule(),
               case.seamless, case.certify, bool(surface)))
    return result


# ------------------------------------------------------------------ campaign
def task(arguments):
    """Returns the results of one task with its own random numbers, or the message of a failed run."""
    number, program = arguments
    rng = random.Random('%d/%d' % (program.seed, number))
    names = list(KINDS) + [None]
    weights = [weight for weight, _ in KINDS.values()] + [RUNS_WEIGHT]
    kind = rng.choices(names, weights)[0]
    folder = Path(tempfile.mkdtemp(dir=program.folder))
    made = [(kind, KINDS[kind][1](rng))] if kind else run_program(rng, program, folder)
    if not isinstance(made, str):
        made = [judge(of, case, '%05d_%d' % (number, k), program, folder)
                for k, (of, case) in enumerate(made)]
    shutil.rmtree(folder)
    return made


def table(results):
    rows = []
    for kind in sorted({r.kind for r in results}) + [None]:
        some = [r for r in results if kind in (r.kind, None)]
        truths, of = Counter(r.truth for r in some), Counter((r.outcome(), r.truth) for r in some)
        outcomes = Counter(r.outcome() for r in some)
        accepted = sum(r.outcome() == 'wrong' and r.verdict == VALID for r in some)
        rows.append([kind or '**all**', len(some), truths[VALID],
                     truths[INVALID] + truths[UNREADABLE], outcomes['right'], of[UNDECIDED, VALID],
                     of[UNDECIDED, INVALID] + of[UNDECIDED, UNREADABLE], outcomes['wrong'],
                     accepted])
    return common.markdown_table(['kind', 'files', 'valid', 'invalid', 'right', 'valid undecided',
                                  'invalid undecided', 'wrong', 'invalid proven'], rows)


def summary(results, program, seconds):
    apart = Counter(r.verdict for r in results if r.truth == DIFFERS)
    no_truth = sum(r.truth is None for r in results)
    return ['', '%d files, seed %d: %d VTU; degrees 1 to 4: %s; %d closed or with holes; 1 to %d '
             'faces, %d files with more than 200.'
             % (len(results), program.seed, sum(r.extension == '.vtu' for r in results),
                ', '.join(str(sum(r.degree == d for r in results)) for d in range(1, 5)),
                sum(r.is_closed for r in results), max(r.faces for r in results),
                sum(r.faces > 200 for r in results)),
             'OBJ whose decimals and doubles differ, apart: %s. Without a truth (the checker could '
             'not decide either): %d. The checker left open %d files whose truth is known by '
             'construction, and disputed %d.'
             % (', '.join('%d %s' % (n, v) for v, n in sorted(apart.items())) or 0, no_truth,
                sum(r.checker == UNDECIDED and r.truth is not None for r in results),
                sum(r.is_disputed for r in results)),
             '`check`: %.0f s in all, at most %.1f s a file. The campaign: %.0f s.'
             % (sum(r.seconds for r in results), max(r.seconds for r in results), seconds)]


def complaints(results):
    return ['%s: %s (%s): truth %s, checker %s, program %s'
            % ('disputed' if r.is_disputed else r.outcome(), r.name, r.kind, r.truth, r.checker,
               r.verdict)
            for r in results if r.is_disputed or r.outcome() == 'wrong'
            or r.outcome() == UNDECIDED and r.truth == VALID]


def holds(results):
    valid = [r for r in results if r.truth == VALID]
    undecided = [r for r in valid if r.outcome() == UNDECIDED]
    return not (any(r.outcome() == 'wrong' or r.is_disputed for r in results)
                or len(undecided) > MOST_UNDECIDED * len(valid) or 3 * len(valid) < len(results)
                or any(r.kind.startswith(WRITTEN) for r in undecided))


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    common.add_options(parser, timeout=60)
    parser.add_argument('--count', type=int, default=5000)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--jobs', type=int, default=1)
    parser.add_argument('--keep', type=Path, help='folder for files that are judged wrongly')
    return parser.parse_args()


def main():
    program, start = parse_arguments(), time.monotonic()
    results, refused = [], []
    program.knows = common.run([program.binary.resolve(), 'check', '--help'], 10).stdout
    os.environ['OPENBLAS_NUM_THREADS'] = '1'
    with tempfile.TemporaryDirectory(prefix='majorant_campaign_') as folder, \
            multiprocessing.Pool(program.jobs) as pool:
        program.folder = folder
        for first in itertools.count(0, 100):
            batch = [(number, program) for number in range(first, first + 100)]
            for some in pool.imap(task, batch):
                if isinstance(some, str):
                    refused.append(some)
                else:
                    results += some
            if len(results) >= program.count:
                break
    results = results[:program.count]
    print('\n'.join(table(results) + summary(results, program, time.monotonic() - start)))
    for line in ['a run wrote nothing: ' + message for message in refused] + complaints(results):
        print(line, file=sys.stderr)
    return 0 if holds(results) else 1


if __name__ == '__main__':
    sys.exit(main())
