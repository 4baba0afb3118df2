#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Compares majorant mesh optimize with gmsh's three optimizers of curved meshes, on thirty models of
OpenCASCADE.

    tests/campaigns/gmsh_models.py build/release/apps/majorant [--orders 2 3 4] [--models 30] [--limit 300]

Needs python3-gmsh. gmsh meshes each model with at most 2,000 tetrahedra and puts the nodes of the order on
the model's surfaces. The mesh is then passed to each of

    HighOrder, HighOrderElastic, HighOrderFastCurving    gmsh.model.mesh.optimize(), all that it does by default
    majorant mesh optimize                               with no flag but --threads 1
    majorant mesh optimize --target initial              likewise: what gmsh's optimizers aim at, too
    majorant mesh optimize --energy amips-exponential    likewise: the worst elements count most
    majorant mesh optimize --energy mips --target initial    likewise: shapes alone, as they were while straight

`majorant mesh check` judges every result: whether all elements are proven valid, and the least and the mean
scaled Jacobian. gmsh moves nodes along curved surfaces; majorant keeps the boundary. Times are CPU seconds:
of gmsh's call only, and of majorant's whole process with reading, proofs and writing.

Prints a line for each model and order, then for each of majorant's runs the number of meshes that meet each
condition:

    valid    majorant's mesh is valid if one of gmsh's is
    least    its least scaled Jacobian is at least that of the best of gmsh's valid meshes, up to 1e-3
    mean     likewise the mean, at least the largest
    time     it took at most the CPU time of the optimizer that has this least scaled Jacobian

Models that gmsh cannot mesh are reported and left out. Exit code 1 if majorant's mesh is not valid although
one of gmsh's is, or a written mesh is not valid.
"""
import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import time

MOST_ELEMENTS = 2000
OPTIMIZERS = ('HighOrder', 'HighOrderElastic', 'HighOrderFastCurving')
EQUAL = 1e-3  # tolerance of scaled Jacobians
FLAGS = ((), ('--target', 'initial'), ('--energy', 'amips-exponential'), ('--energy', 'mips', '--target', 'initial'))


# ---------------------------------------------------------------- models: volumes of gmsh.model.occ
def occ():
    import gmsh
    return gmsh.model.occ


def volumes(tags):
    return [(3, tag) for tag in (tags if isinstance(tags, (list, tuple)) else [tags])]


def cut(one, others):
    return occ().cut(volumes(one), volumes(others))[0]


def fuse(one, others):
    return occ().fuse(volumes(one), volumes(others))[0]


def common(one, others):
    return occ().intersect(volumes(one), volumes(others))[0]


def cylinder(x=0, y=0, z=0, dx=0, dy=0, dz=1, r=1.0):
    return occ().addCylinder(x, y, z, dx, dy, dz, r)


def around(count, radius, make):
    return [make(radius * math.cos(2 * math.pi * k / count), radius * math.sin(2 * math.pi * k / count))
            for k in range(count)]


def holed(count, radius=0.6, hole=0.18, height=0.6):
    cut(cylinder(dz=height), around(count, radius, lambda x, y: cylinder(x, y, -0.1, dz=height + 0.2, r=hole)))


def polygon(points, height):
    o = occ()
    corners = [o.addPoint(x, y, 0) for x, y in points]
    lines = [o.addLine(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    face = o.addPlaneSurface([o.addCurveLoop(lines)])
    return o.extrude([(2, face)], 0, 0, height)[1][1]


def toothed(teeth, inner, outer, height=0.4):
    """Returns tips and roots of a quarter of a tooth each, with straight flanks."""
    points = []
    for k in range(teeth):
        for part, r in ((-0.3, inner), (-0.15, outer), (0.15, outer), (0.3, inner)):
            angle = 2 * math.pi * (k + part) / teeth
            points.append((r * math.cos(angle), r * math.sin(angle)))
    return polygon(points, height)


def gear(teeth, bore=0.4):
    cut(toothed(teeth, 0.8, 1.0), cylinder(z=-0.1, dz=0.6, r=bore))


def ring_gear(teeth):
    cut(cylinder(dz=0.4, r=1.3), toothed(teeth, 0.8, 1.0))


def gear_with_holes(teeth):
    (body,) = cut(toothed(teeth, 0.8, 1.0), cylinder(z=-0.1, dz=0.6, r=0.25))
    cut(body[1], around(5, 0.52, lambda x, y: cylinder(x, y, -0.1, dz=0.6, r=0.12)))


def dice():
    (body,) = common(occ().addBox(-1, -1, -1, 2, 2, 2), occ().addSphere(0, 0, 0, 1.4))
    cut(body[1], [occ().addSphere(x, y, z, 0.3) for x, y, z in
                  ((1, 0, 0), (0, 1.0, 0), (0.4, 0.4, 1), (-0.4, -0.4, 1), (-1, 0.4, 0.4), (-1, -0.4, -0.4))])


def steinmetz():
    (body,) = common(cylinder(z=-2, dz=4), cylinder(x=-2, dx=4, dz=0))
    common(body[1], cylinder(y=-2, dy=4, dz=0))


def flange():
    (body,) = fuse(cylinder(dz=0.3, r=1.2), cylinder(dz=1, r=0.6))
    (body,) = cut(body[1], cylinder(z=-0.1, dz=1.2, r=0.4))
    cut(body[1], around(6, 0.9, lambda x, y: cylinder(x, y, -0.1, dz=0.5, r=0.12)))


def elbow(angle=math.pi / 2):
    o = occ()
    outer, inner = o.addTorus(0, 0, 0, 1.5, 0.5, -1, angle), o.addTorus(0, 0, 0, 1.5, 0.35, -1, angle)
    cut(outer, inner)


def tee():
    (body,) = fuse(cylinder(x=-1.5, dx=3, dz=0, r=0.6), cylinder(dz=1.5, r=0.5))
    (body,) = cut(body[1], cylinder(x=-1.6, dx=3.2, dz=0, r=0.45))
    cut(body[1], cylinder(dz=1.6, r=0.35))


def bracket():
    o = occ()
    (body,) = fuse(o.addBox(0, 0, 0, 2, 1, 0.3), o.addBox(0, 0, 0, 0.3, 1, 1.5))
    cut(body[1], [cylinder(1.3, 0.5, -0.1, dz=0.5, r=0.25), cylinder(-0.1, 0.5, 1, dx=0.5, dz=0, r=0.25)])


def crank():
    (body,) = fuse(cylinder(dz=0.4, r=0.7), [cylinder(2, 0, dz=0.4, r=0.4), occ().addBox(0, -0.25, 0.05, 2, 0.5, 0.3)])
    cut(body[1], [cylinder(z=-0.1, dz=0.6, r=0.35), cylinder(2, 0, -0.1, dz=0.6, r=0.2)])


def ellipsoid():
    ball = occ().addSphere(0, 0, 0, 1)
    occ().dilate([(3, ball)], 0, 0, 0, 2, 1, 0.6)


MODELS = {
    'ball': lambda: occ().addSphere(0, 0, 0, 1),
    'half_ball': lambda: occ().addSphere(0, 0, 0, 1, angle1=0),
    'shell': lambda: cut(occ().addSphere(0, 0, 0, 1), occ().addSphere(0, 0, 0, 0.6)),
    'lens': lambda: common(occ().addSphere(-0.6, 0, 0, 1), occ().addSphere(0.6, 0, 0, 1)),
    'two_balls': lambda: fuse(occ().addSphere(0, 0, 0, 1), occ().addSphere(1.2, 0, 0, 0.8)),
    'ellipsoid': ellipsoid,
    'cylinder': lambda: cylinder(dz=2),
    'tube': lambda: cut(cylinder(dz=2), cylinder(z=-0.1, dz=2.2, r=0.75)),
    'half_tube': lambda: cut(occ().addCylinder(0, 0, 0, 0, 0, 2, 1, angle=math.pi), cylinder(z=-0.1, dz=2.2, r=0.6)),
    'one_hole': lambda: cut(cylinder(), cylinder(0.3, 0.2, -0.1, dz=1.2, r=0.3)),
    'three_holes': lambda: holed(3, 0.5, 0.25),
    'six_holes': lambda: holed(6),
    'crossed': lambda: cut(cylinder(z=-1.5, dz=3), cylinder(x=-2, dx=4, dz=0, r=0.6)),
    'cone': lambda: cut(occ().addCone(0, 0, 0, 0, 0, 1.5, 1, 0.4), cylinder(z=-0.1, dz=1.7, r=0.25)),
    'torus': lambda: occ().addTorus(0, 0, 0, 1, 0.4),
    'half_torus': lambda: occ().addTorus(0, 0, 0, 1, 0.4, -1, math.pi),
    'box_less_ball': lambda: cut(occ().addBox(0, 0, 0, 1, 1, 1), occ().addSphere(1, 1, 1, 0.7)),
    'box_with_cavity': lambda: cut(occ().addBox(-1, -1, -1, 2, 2, 2), occ().addSphere(0, 0, 0, 0.8)),
    'box_and_rod': lambda: fuse(occ().addBox(-0.5, -0.5, -0.5, 1, 1, 1), cylinder(x=-1.2, dx=2.4, dz=0, r=0.3)),
    'round_box': lambda: common(occ().addBox(-1, -1, -1, 2, 2, 2), occ().addSphere(0, 0, 0, 1.3)),
    'steinmetz': steinmetz,
    'dice': dice,
    'flange': flange,
    'elbow': elbow,
    'tee': tee,
    'bracket': bracket,
    'crank': crank,
    'gear': lambda: gear(12),
    'ring_gear': lambda: ring_gear(10),
    'gear_with_holes': lambda: gear_with_holes(16),
}


# ---------------------------------------------------------------- in processes of their own
def start_gmsh():
    import gmsh
    gmsh.initialize()
    gmsh.option.setNumber('General.Terminal', 0)
    gmsh.option.setNumber('General.NumThreads', 1)
    return gmsh


def elements(gmsh):
    return sum(len(tags) for tags in gmsh.model.mesh.getElements(3)[1])


def mesh_of_size(gmsh, size):
    """Returns the number of elements; 0 if gmsh makes no mesh of this size."""
    for option in ('Mesh.MeshSizeMin', 'Mesh.MeshSizeMax'):
        gmsh.option.setNumber(option, size)
    gmsh.model.mesh.clear()
    try:
        gmsh.model.mesh.generate(3)
    except Exception:  # the type of gmsh's errors
        return 0
    return elements(gmsh)


def make(name, order, path):
    """Makes the finest mesh of at most MOST_ELEMENTS whose size is 0.9^k times half the diagonal."""
    gmsh = start_gmsh()
    MODELS[name]()
    gmsh.model.occ.synchronize()
    low, high = (gmsh.model.getBoundingBox(-1, -1)[k:k + 3] for k in (0, 3))
    size = math.dist(low, high) / 2
    best = None
    for _ in range(40):
        count = mesh_of_size(gmsh, size)
        if count > MOST_ELEMENTS:
            break
        if count > 0:
            best = size
        size *= 0.9
    if best is None:
        sys.exit('%s: no mesh of at most %d elements' % (name, MOST_ELEMENTS))
    mesh_of_size(gmsh, best)
    gmsh.model.mesh.setOrder(order)
    gmsh.write(path)


def optimize(name, order, method, path):
    """Optimizes on the model itself, on which nodes may move; prints the CPU seconds of the call."""
    gmsh = start_gmsh()
    MODELS[name]()
    gmsh.model.occ.synchronize()
    gmsh.merge(path)
    before = time.process_time()
    gmsh.model.mesh.optimize(method)
    print(time.process_time() - before)
    gmsh.write(path)


# ---------------------------------------------------------------- the campaign
class Campaign:
    def __init__(self, requested, folder):
        self.requested, self.folder = requested, folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def itself(self, *words):
        try:
            return subprocess.run([sys.executable, os.path.abspath(__file__), *map(str, words)], capture_output=True,
                                  text=True, timeout=self.requested.limit)
        except subprocess.TimeoutExpired:
            return None

    def judged(self, path, seconds):
        """Returns None without a mesh; else whether it is valid, its scaled Jacobians and the time."""
        if not os.path.exists(path):
            return None
        report = self.path('check.json')
        run = subprocess.run([self.requested.binary, 'mesh', 'check', path, '-q', '--list', '0', '--report', report],
                             capture_output=True, text=True)
        if run.returncode not in (0, 5):
            sys.exit(run.stderr)
        with open(report) as file:
            mesh = json.load(file)['result']['mesh']
        return {'valid': run.returncode == 0, 'least': mesh['min_scaled_jacobian'],
                'mean': mesh['mean_scaled_jacobian'], 'seconds': seconds, 'elements': mesh['checked'],
                'invalid': mesh['checked'] - mesh['valid']}

    def of_gmsh(self, name, order, method, source):
        path = self.path(method + '.msh')
        with open(source, 'rb') as of, open(path, 'wb') as to:
            to.write(of.read())
        run = self.itself('--optimize', name, order, method, path)
        if run is None or run.returncode != 0:
            return None
        return self.judged(path, float(run.stdout.split()[-1]))

    def of_majorant(self, source, flags):
        path = self.path('majorant.msh')
        if os.path.exists(path):
            os.remove(path)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.requested.binary, 'mesh', 'optimize', source, '-o', path, '--threads', '1', '-q', *flags,
                        '--time-limit', str(self.requested.limit)], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return self.judged(path, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)

    def compare(self, name, order):
        source = self.path('model.msh')
        made = self.itself('--make', name, order, source)
        if made is None or made.returncode != 0:
            why = '' if made is None else made.stderr.strip()
            print('%-16s %d not meshed by gmsh: %s' % (name, order, why), flush=True)
            return []
        first = self.judged(source, 0)
        found = [self.of_gmsh(name, order, method, source) for method in OPTIMIZERS]
        ours = [self.of_majorant(source, flags) for flags in FLAGS]
        line = '%-16s %d %5d elements, %4d not valid, J %6.3f %.3f' % (
            name, order, first['elements'], first['invalid'], first['least'], first['mean'])
        for one in (*found, *ours):
            line += ' | ' + ('-' if one is None else '%s J %6.3f %.3f %6.2f s' % (
                'valid' if one['valid'] else '%d bad' % one['invalid'], one['least'], one['mean'], one['seconds']))
        print(line, flush=True)
        theirs = [one for one in found if one and one['valid']]
        return [self.verdict(theirs, one) for one in ours]

    @staticmethod
    def verdict(theirs, ours):
        """Returns the conditions that hold, and True if majorant wrote an invalid mesh."""
        is_valid = ours is not None and ours['valid']
        holds = {'valid': is_valid or not theirs}
        if theirs and is_valid:
            best = max(theirs, key=lambda one: one['least'])
            holds['least'] = ours['least'] >= best['least'] - EQUAL
            holds['mean'] = ours['mean'] >= max(one['mean'] for one in theirs) - EQUAL
            holds['time'] = ours['seconds'] <= best['seconds']
        return holds, ours is not None and not is_valid


def main():
    words = sys.argv[1:]
    if words[:1] == ['--make']:
        return make(words[1], int(words[2]), words[3])
    if words[:1] == ['--optimize']:
        return optimize(words[1], int(words[2]), words[3], words[4])
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('binary')
    parser.add_argument('--orders', type=int, nargs='+', default=[2, 3, 4])
    parser.add_argument('--models', type=int, default=len(MODELS), help='number of models')
    parser.add_argument('--limit', type=float, default=300, help='seconds per run')
    requested = parser.parse_args()
    ours = [' '.join(('majorant', *flags)) for flags in FLAGS]
    print('model, order | ' + ' | '.join((*OPTIMIZERS, *ours)) + '; J: least and mean scaled Jacobian', flush=True)
    sums, wrong = {}, 0
    with tempfile.TemporaryDirectory() as folder:
        campaign = Campaign(requested, folder)
        for order in requested.orders:
            for name in list(MODELS)[:requested.models]:
                for who, (holds, is_wrong) in zip(ours, campaign.compare(name, order)):
                    wrong += is_wrong or not holds.get('valid', True)
                    for key, value in holds.items():
                        held, of = sums.get((who, key), (0, 0))
                        sums[who, key] = (held + value, of + 1)
    for who in ours:
        held = ('%s %d of %d' % (key, *pair) for (whose, key), pair in sums.items() if whose == who)
        print('sum of %s: ' % who + '; '.join(held))
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
