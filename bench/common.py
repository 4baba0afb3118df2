#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Shared code of the scripts in this folder: the harness (options, an idle machine, tables), processes, reports,
OBJ files, the initial map.

The initial map is computed here on purpose, independently of the program and of shared/tools:
uniform-weight Tutte embedding, boundary on a circle of the surface's area, arc-length spacing.

As a program it cuts every edge of a triangle OBJ into equal parts, which makes larger meshes of the same surface.

Sample run:
  bench/common.py 10 ../shared/data/public/disks/spot_10000.obj /tmp/spot_1000000.obj
"""
import argparse
import json
import math
import os
import subprocess
import sys
import time
from collections import namedtuple
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DEFAULT_SHARED = ROOT.parent / 'shared'
DEFAULT_BINARY = ROOT / 'build/release/apps/majorant'
PYTHON = '/usr/bin/python3'                       # an interpreter with numpy and scipy
TIMEOUT = 'timeout'                               # the exit code of a process killed by its time limit
IDLE = 0.1                                        # upper bound on the load of an idle machine, as a fraction of its processors

Finished = namedtuple('Finished', 'code stdout stderr seconds')


# ------------------------------------------------------------------ the harness
def parser(about, timeout=600):
    """Returns the parser of a script, with its docstring as help and the options that every script has."""
    made = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_options(made, timeout)
    return made


def add_options(parser, timeout=600):
    parser.add_argument('--shared', type=Path, default=DEFAULT_SHARED, help='folder with data/ and tools/')
    parser.add_argument('--binary', type=Path, default=DEFAULT_BINARY, help='the majorant program')
    parser.add_argument('--timeout', type=float, default=timeout, help='seconds a single process may take')
    parser.add_argument('--busy', action='store_true', help='measure although the machine has other work')


def busy_share(seconds=0.5):
    """Returns the time of other processes as a fraction of this time and the idle time, 0 to 1."""
    def times():
        fields = Path('/proc/stat').read_text().splitlines()[0].split()[1:]
        return sum(map(int, fields)), int(fields[3]) + int(fields[4])
    (all_before, idle_before), _, (all_after, idle_after) = times(), time.sleep(seconds), times()
    return 1 - (idle_after - idle_before) / max(1, all_after - all_before)


def require_idle(options):
    """Ends a script that measures seconds if the machine has other work, unless --busy is given."""
    share = busy_share()
    if share > IDLE and not options.busy:
        sys.exit('the machine is busy: %.0f %% of its processors; wait, or add --busy' % (100 * share))


class Table:
    """A Markdown table that is printed row by row, with a record of whether all rows keep their targets."""

    def __init__(self, title, *header):
        if title:
            print('### %s\n' % title)
        self.kept = True
        self.say(*markdown_table(header, []))

    def say(self, *lines):
        print('\n'.join(lines), flush=True)

    def row(self, *cells):
        self.say('| %s |' % ' | '.join('%s' % cell for cell in cells))

    def judged(self, *cells, kept):
        """Prints a row whose last cell states whether the target is kept."""
        self.kept = self.kept and kept
        self.row(*cells, 'yes' if kept else '**no**')

    def end(self, *lines):
        self.say(*([''] if lines else []), *lines)
        print()
        return self


def require_files(options):
    """Ends the script with one line if the program or the shared folder is missing."""
    for path in (options.binary, options.shared / 'tools/verify.py', options.shared / 'data/public'):
        if not path.exists():
            sys.exit('%s: no such file (see --binary and --shared)' % path)


# ------------------------------------------------------------------ processes
def run(command, timeout, env=None):
    """Runs a command. The exit code `code` is negative for a signal, or TIMEOUT."""
    start = time.monotonic()
    command = [str(word) for word in command]
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors='replace', timeout=timeout,
                              env=env, stdin=subprocess.DEVNULL)
        code, out, err = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        code, out, err = TIMEOUT, '', 'killed after %g s' % timeout
    return Finished(code, out, err, time.monotonic() - start)


def parametrize(options, mesh, outputs, *flags, verb='parametrize'):
    """Runs majorant VERB MESH -o OUT... FLAGS --quiet."""
    command = [options.binary.resolve(), verb, mesh]
    for path in outputs:
        command += ['-o', path]
    return run(command + list(flags) + ['--quiet'], options.timeout)


def verify(options, result, mesh=None, constraints=None, *flags):
    """Returns the JSON object that verify.py prints, or {"error": reason}."""
    command = [PYTHON, options.shared / 'tools/verify.py', result]
    command += ['--mesh', mesh] if mesh else []
    command += ['--constraints', constraints] if constraints else []
    command += flags
    single = dict(os.environ, OMP_NUM_THREADS='1', OPENBLAS_NUM_THREADS='1')
    done = run(command, options.timeout, single)
    try:
        return json.loads(done.stdout)
    except ValueError:
        return {'error': (done.stderr.strip() or 'exit %s' % done.code).splitlines()[-1]}


def failed_checks(checked):
    """Returns the names of failed checks of verify.py; empty for a good result."""
    if 'error' in checked:
        return [checked['error']]
    return [name for name, good in checked['ok'].items() if not good and name != 'all']


# ------------------------------------------------------------------ reports
def refuse_constant(word):
    raise ValueError('%s is not a JSON number' % word)


def load_strict(path):
    """Reads JSON without NaN and Infinity, which raise ValueError."""
    return json.loads(Path(path).read_text(), parse_constant=refuse_constant)


def load_report(path):
    """Returns (report, problem): {} and the reason if the report is missing or not strict JSON."""
    try:
        return load_strict(path), None
    except (OSError, ValueError) as error:
        return {}, 'report: %s' % error


def steps_taken(report):
    """Returns the rows of a report whose step was taken on the input mesh; reports of old programs: all rows."""
    return [row for row in report.get('iterations', [])
            if row.get('outcome', 'moved') == 'moved' and row.get('level', 0) == 0]


def factorizations(report):
    """Returns the number of factorizations on the input mesh, including rejected steps."""
    return sum(row.get('factorizations', 1) for row in report.get('iterations', [])
               if row.get('level', 0) == 0)


def markdown_table(header, rows):
    """Returns the lines of a Markdown table; cells are converted to text."""
    lines = ['| %s |' % ' | '.join(header), '|%s' % ('---|' * len(header))]
    return lines + ['| %s |' % ' | '.join(str(cell) for cell in row) for row in rows]


def cell(value, form='%s'):
    """Returns a table cell; a dash for a missing value."""
    return '-' if value is None else form % value


# ------------------------------------------------------------------ meshes
def read_obj(path):
    """Returns vertices (#V by 3) and faces (#F by 3, 0-based) of a triangle OBJ."""
    import numpy as np
    vertices, faces = [], []
    for line in Path(path).read_text().splitlines():
        words = line.split()
        if words[:1] == ['v']:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ['f']:
            faces.append([int(word.split('/')[0]) - 1 for word in words[1:]])
    return np.array(vertices), np.array(faces)


def write_obj(path, vertices, faces, uv=None):
    """Writes a triangle OBJ with 17 digits; uv (#V by 2) becomes vt, one per vertex."""
    lines = ['v %.17g %.17g %.17g' % tuple(v) for v in vertices]
    lines += ['vt %.17g %.17g' % tuple(v) for v in ([] if uv is None else uv)]
    corner = '%d' if uv is None else '%d/%d'
    repeat = 1 if uv is None else 2
    for face in faces:
        lines.append('f ' + ' '.join(corner % ((i + 1,) * repeat) for i in face))
    Path(path).write_text('\n'.join(lines) + '\n')


def boundary_loop(faces):
    """Returns the boundary vertices of a disk in face orientation, the least index first."""
    directed = {(int(f[i]), int(f[i - 2])) for f in faces for i in range(3)}
    following = {a: b for a, b in directed if (b, a) not in directed}
    loop = [min(following)]
    while following[loop[-1]] != loop[0]:
        loop.append(following[loop[-1]])
    return loop


def surface_area(vertices, faces):
    import numpy as np
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def circle(vertices, loop, radius):
    """Returns points of the loop on a circle around the origin, spaced by arc length, the first at angle 0."""
    import numpy as np
    length = np.linalg.norm(np.roll(vertices[loop], -1, axis=0) - vertices[loop], axis=1)
    angle = 2 * math.pi * (np.cumsum(length) - length) / length.sum()
    return radius * np.stack([np.cos(angle), np.sin(angle)], 1)


def tutte(vertices, faces):
    """Returns (uv, loop): the uniform-weight Tutte embedding on a circle of the surface's area."""
    import numpy as np
    import scipy.sparse as sparse
    from scipy.sparse.linalg import splu
    count, loop = len(vertices), boundary_loop(faces)
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    ends = np.unique(np.sort(ends, axis=1), axis=0)
    half = sparse.coo_matrix((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), (count, count))
    weights = (half + half.T).tocsr()
    laplacian = (sparse.diags(np.asarray(weights.sum(1)).ravel()) - weights).tocsr()
    uv = np.zeros((count, 2))
    uv[loop] = circle(vertices, loop, math.sqrt(surface_area(vertices, faces) / math.pi))
    inner = np.setdiff1d(np.arange(count), loop)
    if len(inner):
        right = -laplacian[inner][:, loop] @ uv[loop]
        uv[inner] = splu(laplacian[inner][:, inner].tocsc()).solve(right)
    return uv, loop


def subdivided(vertices, faces, pieces):
    """Returns (vertices, faces) with every edge cut into `pieces` equal parts, every face into pieces^2."""
    import numpy as np
    weights = np.array([(pieces - j - k, j, k) for j in range(pieces + 1) for k in range(pieces + 1 - j)])
    place = {tuple(w): i for i, w in enumerate(weights[:, 1:].tolist())}
    corners = [(place[j, k], place[j + 1, k], place[j, k + 1])
               for j in range(pieces) for k in range(pieces - j)]
    corners += [(place[j + 1, k], place[j + 1, k + 1], place[j, k + 1])
                for j in range(pieces) for k in range(pieces - 1 - j)]
    # A point is identified by the vertices that contribute to it, in ascending order.
    parts = np.tile(weights, (len(faces), 1))
    owners = np.where(parts > 0, np.repeat(faces, len(weights), axis=0), -1)
    order = np.argsort(owners, axis=1)
    keys = np.hstack([np.take_along_axis(a, order, 1) for a in (owners, parts)])
    _, first, name = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    positions = np.einsum('pk,pkx->px', parts[first] / pieces, vertices[owners[first]])
    name = name.reshape(len(faces), len(weights))
    return positions, name[:, np.array(corners)].reshape(-1, 3)


# ------------------------------------------------------------------ result files
def boundary_curves(shared, path):
    """Returns the uv control points (#edges by n+1 by 2) of the boundary edges of a VTU."""
    import numpy as np
    tools = str(Path(shared) / 'tools')
    if tools not in sys.path:
        sys.path.append(tools)
    import bezier
    import vtu
    data = vtu.read_vtu(path)
    points = np.array(bezier.edge_points(data['degree']))
    edges = data['cells'][:, points].reshape(-1, points.shape[1])
    _, inverse, uses = np.unique(np.sort(edges[:, [0, -1]], axis=1), axis=0, return_inverse=True,
                                 return_counts=True)
    return data['uv'][edges[uses[inverse.ravel()] == 1]]


def straightness(curves):
    """Returns the largest distance of a control point from its place on the evenly divided chord, relative to the
    size of all curves."""
    import numpy as np
    s = np.linspace(0, 1, curves.shape[1])[None, :, None]
    chord = (1 - s) * curves[:, :1] + s * curves[:, -1:]
    size = np.linalg.norm(np.ptp(curves.reshape(-1, 2), axis=0))
    return float(np.linalg.norm(curves - chord, axis=2).max() / size)


if __name__ == '__main__':
    write_obj(sys.argv[3], *subdivided(*read_obj(sys.argv[2]), int(sys.argv[1])))
