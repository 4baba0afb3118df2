# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The exact sign of det J on curved cells, by rational subdivision: the oracle of `majorant mesh check`.

Nothing here shares code or formulas with the library: polynomials are dictionaries of exponents, control
points come from solving for them in fractions, pieces are halved by de Casteljau in integers.

    cell = Cell('tetrahedron', 2)
    cell.minimum(nodes)            # (sign, lower, upper): sign 1, -1, or 0 if undecided
"""
from fractions import Fraction
from itertools import product
from math import factorial

# The numbers of corners of the factors of each kind.
FACTORS = {'triangle': (3,), 'quad': (2, 2), 'tetrahedron': (4,), 'wedge': (3, 2), 'hexahedron': (2, 2, 2)}
LAGRANGE_TYPE = {'triangle': 69, 'quad': 70, 'tetrahedron': 71, 'hexahedron': 72, 'wedge': 73}


def compositions(total, parts):
    if parts == 1:
        return [(total,)]
    return [(k,) + rest for k in range(total, -1, -1) for rest in compositions(total - k, parts - 1)]


def multinomial(exponents):
    value = factorial(sum(exponents))
    for e in exponents:
        value //= factorial(e)
    return value


def simplex_order(corners, n, shift=0):
    """Returns VTK's recursive order of the nodes of a triangle or tetrahedron."""
    if n < 0:
        return []
    if n == 0:
        return [(shift,) * corners]

    def at(*terms):
        e = [shift] * corners
        for c, k in terms:
            e[c] += k
        return tuple(e)
    out = [at((c, n)) for c in range(corners)]
    edges = [(0, 1), (1, 2), (2, 0)] if corners == 3 else [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
    out += [at((a, n - s), (b, s)) for a, b in edges for s in range(1, n)]
    if corners == 3:
        return out + simplex_order(3, n - 3, shift + 1)
    for face in ((0, 1, 3), (2, 3, 1), (0, 3, 2), (0, 2, 1)):
        out += [at(*((c, k + 1) for c, k in zip(face, e))) for e in (simplex_order(3, n - 3) if n >= 3 else [])]
    return out + simplex_order(4, n - 4, shift + 1)


def grid_order(dim, n):
    """Returns VTK's order on a square or cube as indices by coordinate
    (vtkHigherOrderHexahedron::PointIndexFromIJK)."""
    m = n - 1
    found = {}
    for ijk in product(range(n + 1), repeat=dim):
        i, j, k = ijk + (0,) * (3 - dim)
        ibdy, jbdy, kbdy = i in (0, n), j in (0, n), dim == 2 or k in (0, n)
        corner = (2 if j else 1) if i else (3 if j else 0)
        inner = 4 if dim == 2 else 8
        if ibdy and jbdy and kbdy:
            place = corner + (4 if k else 0)
        elif jbdy and kbdy:
            place = inner + (i - 1) + (2 * m if j else 0) + (4 * m if k else 0)
        elif ibdy and kbdy:
            place = inner + (j - 1) + (m if i else 3 * m) + (4 * m if k else 0)
        elif dim == 2:
            place = inner + 4 * m + (i - 1) + m * (j - 1)
        elif ibdy and jbdy:
            place = inner + 8 * m + (k - 1) + m * corner
        elif ibdy:
            place = inner + 12 * m + (j - 1) + m * (k - 1) + (m * m if i else 0)
        elif jbdy:
            place = inner + 12 * m + 2 * m * m + (i - 1) + m * (k - 1) + (m * m if j else 0)
        elif kbdy:
            place = inner + 12 * m + 4 * m * m + (i - 1) + m * (j - 1) + (m * m if k else 0)
        else:
            place = inner + 12 * m + 6 * m * m + (i - 1) + m * ((j - 1) + m * (k - 1))
        found[place] = ijk
    return [found[p] for p in range(len(found))]


def wedge_order(n):
    """Returns the order of vtkHigherOrderWedge::PointIndexFromIJK, as (i, j, k)."""
    m = n - 1
    triangle, square = m * (m - 1) // 2, m * m

    def inside(i, j):
        return sum(n - 1 - b for b in range(1, j)) + i - 1
    found = {}
    for j, k in product(range(n + 1), repeat=2):
        for i in range(n + 1 - j):
            ibdy, jbdy, sbdy, kbdy = i == 0, j == 0, i + j == n, k in (0, n)
            corner = 0 if ibdy and jbdy else 1 if jbdy and sbdy else 2
            count = ibdy + jbdy + sbdy + kbdy
            if count == 3:
                place = corner + (3 if k else 0)
            elif count == 2 and not kbdy:
                place = 6 + 6 * m + (k - 1) + corner * m
            elif count == 2:
                place = 6 + (3 * m if k else 0) + (i - 1 if jbdy else m + j - 1 if sbdy else 2 * m + n - j - 1)
            elif count == 1 and kbdy:
                place = 6 + 9 * m + (triangle if k else 0) + inside(i, j)
            elif count == 1:
                face = (i - 1) if jbdy else square + (n - i - 1) if sbdy else 2 * square + (n - j - 1)
                place = 6 + 9 * m + 2 * triangle + face + m * (k - 1)
            else:
                place = 6 + 9 * m + 2 * triangle + 3 * square + inside(i, j) + triangle * (k - 1)
            found[place] = (i, j, k)
    return [found[p] for p in range(len(found))]


def node_order(kind, n):
    """Returns the exponents of the homogeneous coordinates of every node."""
    if kind in ('triangle', 'tetrahedron'):
        return simplex_order(3 if kind == 'triangle' else 4, n)
    if kind == 'wedge':
        return [(n - i - j, i, j, n - k, k) for i, j, k in wedge_order(n)]
    return [tuple(x for i in ijk for x in (n - i, i)) for ijk in grid_order(2 if kind == 'quad' else 3, n)]


def solve(matrix):
    """Returns the inverse matrix in fractions."""
    n = len(matrix)
    rows = [[Fraction(x) for x in row] + [Fraction(int(i == j)) for j in range(n)] for i, row in enumerate(matrix)]
    for k in range(n):
        pivot = next(r for r in range(k, n) if rows[r][k] != 0)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for r in range(n):
            if r != k and rows[r][k] != 0:
                f = rows[r][k]
                rows[r] = [x - f * y for x, y in zip(rows[r], rows[k])]
    return [row[n:] for row in rows]


class Cell:
    def __init__(self, kind, degree):
        self.kind, self.degree, self.factors = kind, degree, FACTORS[kind]
        self.dim = sum(self.factors) - len(self.factors)
        self.nodes = node_order(kind, degree)
        self.slots, at = [], 0
        for corners in self.factors:
            self.slots.append(range(at, at + corners))
            at += corners
        self._to_control = self._control_matrix()
        # The derivative by reference coordinate d is that by one slot minus that by another.
        self.derivatives = [(s[k], s[0]) for s in self.slots for k in range(1, len(s))]
        self.det_degrees = [self.dim * degree - (c - 1) for c in self.factors]

    def _control_matrix(self):
        n, inverse = self.degree, {}
        for corners in set(self.factors):
            e = compositions(n, corners)
            values = [[multinomial(f) * self._power(node, f, n) for f in e] for node in e]
            inverse[corners] = ({x: k for k, x in enumerate(e)}, solve(values))
        out = []
        for row in self.nodes:
            out.append([])
            for column in self.nodes:
                weight = Fraction(1)
                for slots in self.slots:
                    place, matrix = inverse[len(slots)]
                    weight *= matrix[place[tuple(row[s] for s in slots)]][place[tuple(column[s] for s in slots)]]
                out[-1].append(weight)
        return out

    @staticmethod
    def _power(node, exponents, n):
        value = Fraction(1)
        for x, e in zip(node, exponents):
            value *= Fraction(x, n) ** e
        return value

    def weight(self, e):
        value = 1
        for slots in self.slots:
            value *= multinomial([e[s] for s in slots])
        return value

    def monomials(self, nodes):
        """Returns the map as a polynomial in homogeneous monomials for each coordinate."""
        exact = [[Fraction(x) for x in node] for node in nodes]
        out = []
        for c in range(self.dim):
            values = [node[c] for node in exact]
            out.append({e: self.weight(e) * sum(w * v for w, v in zip(row, values) if w)
                        for e, row in zip(self.nodes, self._to_control)})
        return out

    def derivative(self, polynomial, plus, minus):
        out = {}
        for e, value in polynomial.items():
            for slot, sign in ((plus, 1), (minus, -1)):
                if e[slot]:
                    low = e[:slot] + (e[slot] - 1,) + e[slot + 1:]
                    out[low] = out.get(low, 0) + sign * e[slot] * value
        return out

    @staticmethod
    def times(a, b):
        out = {}
        for e, x in a.items():
            for f, y in b.items():
                g = tuple(map(sum, zip(e, f)))
                out[g] = out.get(g, 0) + x * y
        return out

    def determinant(self, nodes):
        """Returns the Bernstein coefficients of det J as integers over a common denominator."""
        x = self.monomials(nodes)
        j = [[self.derivative(p, *d) for p in x] for d in self.derivatives]
        scale = 1
        for row in j:
            for p in row:
                for value in p.values():
                    scale = scale * value.denominator // _gcd(scale, value.denominator)
        j = [[{e: int(v * scale) for e, v in p.items()} for p in row] for row in j]

        def minor(a, b, p, q):
            first, second = self.times(j[a][p], j[b][q]), self.times(j[a][q], j[b][p])
            return {e: first.get(e, 0) - second.get(e, 0) for e in set(first) | set(second)}
        if self.dim == 2:
            det = minor(0, 1, 0, 1)
        else:
            det = {}
            for c in range(3):
                for e, v in self.times(j[0][c], minor(1, 2, (c + 1) % 3, (c + 2) % 3)).items():
                    det[e] = det.get(e, 0) + v
        lists = [compositions(d, c) for d, c in zip(self.det_degrees, self.factors)]
        whole = 1
        for d in self.det_degrees:
            whole *= factorial(d)
        coefficients = {}
        for parts in product(*lists):
            e = sum(parts, ())
            coefficients[e] = det.get(e, 0) * (whole // self.weight(e))
        return coefficients, whole * scale ** self.dim

    def halves(self, piece, a, b):
        """Returns both halves across the edge between slots a and b, times 2^degree."""
        slots = next(s for s in self.slots if a in s)
        degree = self.det_degrees[self.slots.index(slots)]
        first, second = {}, {}
        for start in piece:
            if start[b]:
                continue
            n = start[a]

            def at(k):
                e = list(start)
                e[a], e[b] = n - k, k
                return tuple(e)
            row = [piece[at(k)] for k in range(n + 1)]
            for r in range(n + 1):
                first[at(r)] = row[0] << (degree - r)
                second[at(n - r)] = row[-1] << (degree - r)
                row = [x + y for x, y in zip(row, row[1:])]
        return first, second, degree

    def longest(self, frame):
        """Returns the edge between slots that is longest in the reference cell."""
        def length(a, b):
            return sum((x - y) ** 2 for x, y in zip(frame[a], frame[b]))
        return max(((a, b) for s in self.slots for a in s for b in s if a < b), key=lambda e: length(*e))

    def minimum(self, nodes, most_pieces=3000):
        coefficients, denominator = self.determinant(nodes)
        size = len(self.nodes[0])
        frame = [[Fraction(int(a == b)) for b in range(size)] for a in range(size)]
        corners = [e for e in coefficients if all(max(e[s] for s in slots) == d
                                                  for slots, d in zip(self.slots, self.det_degrees))]
        open_, sign, upper, lower = [(coefficients, 0, frame)], 1, None, None

        def lower_by(piece, bits):
            nonlocal lower
            value = Fraction(min(piece.values()), denominator << bits)
            lower = value if lower is None else min(lower, value)
        for _ in range(most_pieces):
            if not open_:
                break
            piece, bits, frame = open_.pop()
            value = Fraction(min(piece[e] for e in corners), denominator << bits)
            upper = value if upper is None else min(upper, value)
            if value <= 0:
                sign = -1
                lower_by(piece, bits)
                break
            if min(piece.values()) > 0:
                lower_by(piece, bits)
                continue
            a, b = self.longest(frame)
            first, second, shift = self.halves(piece, a, b)
            middle = [(x + y) / 2 for x, y in zip(frame[a], frame[b])]
            open_.append((first, bits + shift, frame[:b] + [middle] + frame[b + 1:]))
            open_.append((second, bits + shift, frame[:a] + [middle] + frame[a + 1:]))
        for piece, bits, _ in open_:
            lower_by(piece, bits)
            sign = 0 if sign > 0 else sign
        return sign, lower, upper


def _gcd(a, b):
    while b:
        a, b = b, a % b
    return a


def random_nodes(cell, random, spread):
    """Returns a random affine image of the straight reference cell; every node is moved by up to `spread`."""
    size = [[random.uniform(-0.3, 0.3) + (i == k) for k in range(cell.dim)] for i in range(cell.dim)]
    out = []
    for e in cell.nodes:
        x = [Fraction(e[plus], cell.degree) for plus, _ in cell.derivatives]
        out.append([sum(float(a) * s for a, s in zip(x, row)) + random.uniform(-spread, spread) for row in size])
    return out


def value_at(cell, nodes, point):
    """Returns J at a point of homogeneous coordinates; rows are derivatives."""
    rows = []
    x = cell.monomials(nodes)
    for d in cell.derivatives:
        rows.append([sum(v * _monomial(point, e) for e, v in cell.derivative(p, *d).items()) for p in x])
    return rows


def _monomial(point, e):
    value = Fraction(1)
    for x, k in zip(point, e):
        value *= x ** k
    return value


def det(j):
    if len(j) == 2:
        return j[0][0] * j[1][1] - j[0][1] * j[1][0]
    return sum(j[0][c] * (j[1][(c + 1) % 3] * j[2][(c + 2) % 3] - j[1][(c + 2) % 3] * j[2][(c + 1) % 3])
               for c in range(3))


def nearly_singular(cell, nodes, random, target):
    """Returns the nodes with one of them, usually a corner, moved so that det J there is `target` up to rounding:
    det J is linear in each of its coordinates."""
    corners = [k for k, e in enumerate(cell.nodes) if all(max(e[s] for s in slots) == cell.degree for slots in cell.slots)]
    moved = random.choice(corners) if random.random() < 0.75 else random.randrange(len(nodes))
    point = [Fraction(k, cell.degree) for k in cell.nodes[moved]]
    here, best = det(value_at(cell, nodes, point)), None
    for axis in range(cell.dim):
        other = [list(node) for node in nodes]
        other[moved][axis] = nodes[moved][axis] + 1.0
        slope = (det(value_at(cell, other, point)) - here) / (Fraction(other[moved][axis]) - Fraction(nodes[moved][axis]))
        if best is None or abs(slope) > abs(best[1]):
            best = axis, slope
    axis, slope = best
    if slope == 0:
        return nodes
    out = [list(node) for node in nodes]
    out[moved][axis] = float(Fraction(nodes[moved][axis]) + (Fraction(target) - here) / slope)
    return out
