# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Unwraps two hundred hard-surface models, and counts charts above the stretch limit and messages about them.

    python3 tests/campaigns/stretch_limit.py build/release/apps/majorant [--limit 1.015] [--every K]

This script measures the stretch on the digits of the file. The last line has the counts; exit code 1 if they
are not zero.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', 'apps'))
from command_helpers import obj_text  # noqa: E402
from hard_surfaces import family  # noqa: E402
from stretch import stretches  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('majorant')
    parser.add_argument('--limit', type=float, default=1.015)
    parser.add_argument('--every', type=int, default=1)
    args = parser.parse_args()
    above = lost = charts = excused = 0
    seam = []
    with tempfile.TemporaryDirectory() as folder:
        mesh, out, report = (os.path.join(folder, name) for name in ('in.obj', 'out.vtu', 'r.json'))
        models = list(family())[::args.every]
        for name, points, faces in models:
            with open(mesh, 'w') as f:
                f.write(obj_text(points, faces))
            done = subprocess.run([args.majorant, 'unwrap', mesh, '-o', out, '--report', report, '--threads', '1',
                                   '--max-stretch', repr(args.limit)], text=True, stderr=subprocess.PIPE)
            excuses = done.stderr.count('more than --max-stretch')
            excused += excuses
            if done.returncode:
                lost += 1
                print('%-14s exit %d: %s' % (name, done.returncode, done.stderr.strip()[-300:]))
                continue
            with open(report) as f:
                printed = json.load(f)
            found = stretches(out)
            wrong = [s for s in found if s > args.limit + 1e-9]
            above, charts = above + len(wrong), charts + len(found)
            area = sum(chart['area'] for chart in printed['charts'])
            seam.append(printed['result']['seam_length'] / math.sqrt(area))
            if wrong or excuses or args.every > 1 or len(found) > 12:
                print('%-14s %3d charts, stretch %.5f, seam %.2f, energy %.5f' % (
                    name, len(found), max(found), seam[-1], printed['result']['value']))
    seam.sort()
    print('%d models, %d lost, %d charts, %d above %g, %d lines that say why; seam median %.2f, most %.2f' % (
        len(models), lost, charts, above, args.limit, excused, seam[len(seam) // 2], seam[-1]))
    return above + lost + excused > 0


if __name__ == '__main__':
    sys.exit(main())
