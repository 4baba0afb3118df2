#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that two builds write the same maps to the last bit, for changes that must not change results.

Maps every disk at degrees 1 to 3 with free and fixed boundary and without overlaps, the textured
seamless meshes, the closed meshes with `seamless` and `unwrap`, and the deformations. Compares the
bytes of the VTU files, which hold every control point losslessly, and the claimed energies of files
that differ. Files of the old build are kept in --work and made once.

Sample runs:
  bench/same_maps.py --old /tmp/before/majorant --faces 500
  bench/same_maps.py --old /tmp/before/majorant --faces 500,2500,10000 --degrees 1,2,3
"""
import argparse
import re
import sys
from pathlib import Path

import common

KINDS = {'free': [], 'fixed': ['--boundary', 'fixed'], 'bijective': ['--bijective']}


def cases(options):
    """Returns (name, verb and flags) of every run; the mesh is the first word after the verb."""
    data = options.shared / 'data/public'
    for faces in options.faces.split(','):
        for mesh in sorted((data / 'disks').glob('*_%s.obj' % faces)):
            for degree in options.degrees.split(','):
                for kind, flags in KINDS.items():
                    yield ('%s.%s.%s' % (mesh.stem, degree, kind),
                           ['parametrize', mesh, '--degree', degree, *flags])
    for mesh in sorted((data / 'seamless').glob('*.obj')):
        for degree in options.degrees.split(','):
            yield ('%s.%s.seamless' % (mesh.stem, degree),
                   ['parametrize', mesh, '--degree', degree, '--seamless'])
    for mesh in sorted((data / 'closed').glob('*.obj')):
        for verb in ('seamless', 'unwrap'):
            yield ('%s.1.%s' % (mesh.stem, verb), [verb, mesh, '--degree', 1])
    for mesh in sorted((data / 'deform2d').glob('*.obj')):
        for flags in ([], ['--bijective']):
            yield ('%s.2.deform%s' % (mesh.stem, ''.join(flags)),
                   ['deform', mesh, '--handles', mesh.with_suffix('.json'), '--degree', 2, *flags])


def value(path):
    """Returns the energy that a file claims."""
    array = re.search(r'majorant_claims"[^>]*>([\d\s]+)<', path.read_text())  # character codes
    claims = re.search(r'"value": *([-+.\deE]+)', ''.join(chr(int(c)) for c in array[1].split()) if array else '')
    return float(claims[1]) if claims else float('nan')


def write(options, binary, words, target):
    """Runs one case. Returns the exit code."""
    return common.run([binary, *words, '-o', target, '--quiet'], options.timeout).code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    common.add_options(parser)
    parser.add_argument('--old', type=Path, required=True, help='the majorant program to compare with')
    parser.add_argument('--faces', default='500,2500')
    parser.add_argument('--degrees', default='1,2,3')
    parser.add_argument('--work', type=Path, default=Path('out/same_maps'))
    options = parser.parse_args()
    common.require_files(options)
    options.work.mkdir(parents=True, exist_ok=True)
    different = total = 0
    for name, words in cases(options):
        old, new = options.work / (name + '.old.vtu'), options.work / (name + '.new.vtu')
        if not old.exists():
            write(options, options.old.resolve(), words, old)
        new.unlink(missing_ok=True)
        code = write(options, options.binary.resolve(), words, new)
        total += 1
        same = old.exists() == new.exists() and (not new.exists() or old.read_bytes() == new.read_bytes())
        if not same:
            different += 1
            both = old.exists() and new.exists()
            difference = 'energies differ by %.1e' % abs(value(new) / value(old) - 1) if both else 'exit %s' % code
            print('%s: different, %s' % (name, difference), flush=True)
    print('%d of %d runs write the same bytes' % (total - different, total))
    sys.exit(different > 0)


if __name__ == '__main__':
    main()
