# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every verb, found from the program itself, when it is stopped or its files cannot be read or written.

A row is a test, a column a verb. A verb is called like the example of its help; FILES makes the
files that the examples name. In every case the inputs do not change, an output is whole or absent,
no temporary file is left, one line on stderr gives the reason, and the report agrees with the exit code.
"""
import concurrent.futures
import os
import shlex
import signal
import stat
import struct
import subprocess
import time
import zlib

import command_helpers as helpers
from command_helpers import *

VERBS = helpers.verb_names()
SMALL, LARGE = 6, 100      # cells along a side of the grids, of 72 and 20,000 triangles
PATIENCE = 2               # seconds that a run may continue after a stop, by docs/interface.md
ALLOWANCE = 1.5            # additional seconds of one core
SOON = 300                 # seconds on the clock, on a busy machine, until every run must have ended
OUTPUT_OPTIONS = ('-o', '--output', '--report')
SUCCESSES = ('converged', 'valid', 'done')
STOPS = {signal.SIGINT: 'interrupted', signal.SIGTERM: 'interrupted', signal.SIGHUP: 'interrupted',
         None: 'time_limit'}
OLD = b'of an earlier run\n'
CODES = {'max_iterations': LIMIT, 'time_limit': LIMIT, 'interrupted': LIMIT, 'stalled': LIMIT,
         'unreadable': UNREADABLE, 'unsupported': UNSUPPORTED, 'infeasible': UNSUPPORTED, 'failed': INVALID,
         'invalid': INVALID, 'undecided': INVALID, **{status: OK for status in SUCCESSES}}
ENDS = {'.vtu': b'</VTKFile>\n', '.html': b'</html>\n', '.svg': b'</svg>\n', '.png': b'IEND\xaeB`\x82', '.json': b'}\n'}


# ------------------------------------------------------------------ the files that examples name
def layout(n):
    """Returns a surface with texture coordinates inside the unit square."""
    points, faces = grid(n)
    return obj_text(points, faces, [(0.05 + 0.9 * x, 0.05 + 0.9 * y) for x, y, _ in points])


def handles(n):
    last = (n + 1) ** 2 - 1
    return json.dumps({'handles': [{'vertex': 0, 'target': [0, 0]}, {'vertex': n, 'target': [1, 0]},
                                   {'vertex': last, 'target': [1.3, 1.2]}]})


def image(size=64):
    def chunk(kind, data):
        return struct.pack('>I', len(data)) + kind + data + struct.pack('>I', zlib.crc32(kind + data))
    rows = b''.join(b'\0' + bytes((x * y) % 256 for x in range(3 * size)) for y in range(size))
    return (b'\x89PNG\r\n\x1a\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', size, size, 8, 2, 0, 0, 0)) +
            chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def tetrahedra(n):
    """Returns as many elements as a grid has triangles, with moved inner nodes; MSH 2.2."""
    k = max(2, round((n * n / 3) ** (1 / 3)))
    def node(i, j, l):
        return (l * (k + 1) + j) * (k + 1) + i + 1
    nodes, elements = [], []
    for l in range(k + 1):
        for j in range(k + 1):
            for i in range(k + 1):
                inside = 0 < i < k and 0 < j < k and 0 < l < k
                moved = [0.3 * math.sin(7.1 * i + 3.3 * j + 5.7 * l + c) if inside else 0 for c in range(3)]
                nodes.append('%d %r %r %r' % (node(i, j, l), i + moved[0], j + moved[1], l + moved[2]))
                if max(i, j, l) == k:
                    continue
                for one, two in (((1, 0, 0), (1, 1, 0)), ((1, 1, 0), (0, 1, 0)), ((0, 1, 0), (0, 1, 1)),
                                 ((0, 1, 1), (0, 0, 1)), ((0, 0, 1), (1, 0, 1)), ((1, 0, 1), (1, 0, 0))):
                    corners = [(0, 0, 0), one, two, (1, 1, 1)]
                    elements.append('%d 4 2 1 1 %d %d %d %d' % (len(elements) + 1, *(
                        node(i + a, j + b, l + c) for a, b, c in corners)))
    return ('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n%s\n$EndNodes\n$Elements\n%d\n%s\n$EndElements\n' %
            (len(nodes), '\n'.join(nodes), len(elements), '\n'.join(elements)))


def map_of(surface):
    """Returns the start of a map of the surface as a file."""
    def make(n):
        folder = Inputs.of(n)
        done = majorant('parametrize', surface, '-o', 'made.vtu', '--degree', '3', '--max-iterations', '0',
                        '--quiet', cwd=folder.prepare(surface))
        assert done.code == LIMIT, done.err
        with open(os.path.join(folder.path, 'made.vtu'), 'rb') as f:
            return f.read()
    return make


FILES = {
    'bunny.obj': lambda n: obj_text(*grid(n)),  # a disk, for the verbs that require one
    'bunny.vtu': map_of('bunny.obj'),
    'bar.obj': lambda n: obj_text(*grid(n, height=lambda x, y: 0)),
    'bar.json': handles,
    'low.obj': layout,
    'scan.obj': layout,
    'scan.png': lambda n: image(),
    'spot.obj': lambda n: obj_text(*torus(2 * n, n, 0)),  # closed
    'part.msh': tetrahedra,
}


def gltf_of(obj):
    """Returns the mesh as glTF with its positions in named.bin, and a picture on it."""
    lines = [line.split() for line in obj.decode().splitlines()]
    points = [tuple(map(float, words[1:4])) for words in lines if words[:1] == ['v']]
    corners = [int(word.split('/')[0]) - 1 for words in lines if words[:1] == ['f'] for word in words[1:]]
    bounds = {name: [pick(p[c] for p in points) for c in range(3)] for name, pick in (('min', min), ('max', max))}
    data = struct.pack('<%df' % (3 * len(points)), *(x for p in points for x in p)) + struct.pack('<%dI' % len(corners), *corners)
    first = 12 * len(points)
    return json.dumps({
        'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0]}], 'nodes': [{'mesh': 0}],
        'meshes': [{'primitives': [{'attributes': {'POSITION': 0}, 'indices': 1, 'material': 0}]}],
        'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': len(points), 'type': 'VEC3', **bounds},
                      {'bufferView': 1, 'componentType': 5125, 'count': len(corners), 'type': 'SCALAR'}],
        'bufferViews': [{'buffer': 0, 'byteLength': first},
                        {'buffer': 0, 'byteOffset': first, 'byteLength': 4 * len(corners)}],
        'buffers': [{'uri': 'named.bin', 'byteLength': len(data)}], 'images': [{'uri': 'paint.png'}],
        'textures': [{'source': 0}], 'materials': [{'pbrMetallicRoughness': {'baseColorTexture': {'index': 0}}}],
    }).encode(), data


def naming_others(name, content):
    """Yields inputs that name other files, in place of this one: (its name, files, the named ones)."""
    base, ending = os.path.splitext(name)
    found = []
    if ending == '.obj':
        found.append((name, {name: b'mtllib named.mtl\nusemtl paint\n' + content, 'paint.png': image(),
                             'named.mtl': b'newmtl paint\nmap_Kd paint.png\n'}, ('named.mtl', 'paint.png')))
        gltf, data = gltf_of(content)
        found.append((base + '.gltf', {base + '.gltf': gltf, 'named.bin': data, 'paint.png': image()},
                      ('named.bin', 'paint.png')))
    if ending == '.vtu':
        pieces = b'<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="1.0">\n<PUnstructuredGrid>\n' \
                 b'<Piece Source="piece.vtu"/>\n</PUnstructuredGrid>\n</VTKFile>\n'
        found.append((base + '.pvtu', {base + '.pvtu': pieces, 'piece.vtu': content}, ('piece.vtu',)))
    return found


class Inputs:
    """A folder with the files of FILES, each of which is made once, on demand."""
    made = {}

    def __init__(self, size):
        self.size, self.path, self.names = size, tempfile.mkdtemp(prefix='majorant_inputs_'), set()

    @classmethod
    def of(cls, size):
        if size not in cls.made:
            cls.made[size] = cls(size)
        return cls.made[size]

    def prepare(self, *names):
        for name in names:
            if name not in self.names:
                content = FILES[name](self.size)
                with open(os.path.join(self.path, name), 'wb') as f:
                    f.write(content.encode() if isinstance(content, str) else content)
                self.names.add(name)
        return self.path


def tearDownModule():
    for inputs in Inputs.made.values():
        shutil.rmtree(inputs.path)


# ------------------------------------------------------------------ the calls
class Example:
    """The words of the example of a verb, and which of them are files."""

    def __init__(self, verb):
        self.verb, self.help = verb, majorant(*verb.split(), '--help').out
        found = re.search(r'^Example: majorant (.*?)(?:\n\n|\Z)', self.help, re.M | re.S)
        assert found, 'the help of %s ends with no "Example: majorant %s ..."' % (verb, verb)
        self.words = shlex.split(found.group(1))
        assert ' '.join(self.words).startswith(verb + ' '), found.group()
        self.inputs, self.outputs, self.report = [], [], 'r.json'
        for before, word in zip(self.words, self.words[1:]):
            if before == '--report':
                self.report = word
            elif before in OUTPUT_OPTIONS:
                self.outputs.append(word)
            elif word in FILES:
                self.inputs.append(word)
            elif re.fullmatch(r'[\w.-]+\.[a-z]\w*', word):
                raise AssertionError('%s, in the example of `majorant %s --help`: add how it is made to FILES of %s' %
                                     (word, verb, os.path.basename(__file__)))
        if '--report' not in self.words:
            self.words += ['--report', self.report]
        assert self.inputs, 'the example of %s names no input' % verb

        limit = re.search(r'(?m)^  --time-limit .*\n(?:   .*\n)*', self.help)
        self.has_limit = limit is not None
        self.limits_run = self.has_limit and 'each method' not in limit.group()

    def writes(self):
        """Returns the outputs of the verb, or a report if it has no other output."""
        return self.outputs or [self.report]


EXAMPLES = {verb: Example(verb) for verb in VERBS}


def processor_seconds(process):
    with open('/proc/%d/stat' % process.pid) as f:
        fields = f.read().rpartition(') ')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


def is_handling_signals(process):
    with open('/proc/%d/status' % process.pid) as f:
        caught = int(re.search(r'SigCgt:\s*(\w+)', f.read()).group(1), 16)
    return bool(caught >> (signal.SIGINT - 1) & 1)


def is_waiting(process):
    """Returns whether the process sleeps at nearly all of twenty moments."""
    asleep = 0
    for _ in range(20):
        with open('/proc/%d/stat' % process.pid) as f:
            asleep += f.read().rpartition(') ')[2][0] == 'S'
        time.sleep(0.015)
    return asleep >= 16


class Cell:
    """A verb in its own folder, with copies of its inputs."""

    def __init__(self, test, example, size=SMALL):
        self.test, self.example, self.size = test, example, size
        self.folder = tempfile.mkdtemp(prefix='majorant_cell_')
        test.addCleanup(shutil.rmtree, self.folder)
        self.originals = Inputs.of(size).path
        for name in example.inputs:
            shutil.copy(os.path.join(self.originals, name), self.folder)
        self.untouched = set(example.inputs)  # inputs that must not change
        self.others = set()                   # further files that may exist at the end
        self.process = None

    def fill_outputs(self):
        """Makes files of an earlier run at the outputs, so that --force is needed."""
        for name in self.example.outputs + [self.example.report]:
            with open(self.path(name), 'wb') as f:
                f.write(OLD)

    def is_old(self, name):
        if os.path.isdir(self.path(name)) or not stat.S_ISREG(os.stat(self.path(name)).st_mode):
            return False
        with open(self.path(name), 'rb') as f:
            return f.read() == OLD

    def path(self, name):
        return os.path.join(self.folder, name)

    def words(self, renamed={}, more=()):
        """Returns the words of the example with other outputs, small counts for small runs, and one thread, so that
        CPU time is that of the run."""
        words = self.example.words
        words = [renamed.get(word, word) if before in OUTPUT_OPTIONS else word
                 for before, word in zip([''] + words, words)]
        if self.size == SMALL:
            words = [str(int(word) // 16) if re.fullmatch(r'\d{4,}', word) else word for word in words]
        return words + ['--threads', '1', *more]

    def start(self, words, prefix=(), **streams):
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        streams = {'stdin': subprocess.DEVNULL, 'stdout': self.out, 'stderr': self.err, **streams}
        self.process = subprocess.Popen([*prefix, helpers.BINARY, *words], cwd=self.folder, **streams)
        return self.process

    def has_ended(self):
        return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def finish(self):
        """Waits for the end. Returns (CPU time, Outcome)."""
        end = time.monotonic() + SOON
        while True:
            pid, status, usage = os.wait4(self.process.pid, os.WNOHANG)
            if pid:
                break
            if time.monotonic() > end:
                self.process.kill()
                self.process.wait()
                self.test.fail('it does not end; it said: ' + self.text(self.err))
            time.sleep(0.01)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        done = Outcome(subprocess.CompletedProcess([], self.process.returncode, self.text(self.out), self.text(self.err)))
        return usage.ru_utime + usage.ru_stime, done

    @staticmethod
    def text(stream):
        stream.seek(0)
        text = stream.read().decode()
        stream.close()
        return text

    def run(self, words, **method):
        self.start(words, **method)
        return self.finish()[1]

    def send(self, number):
        """Sends a signal, also to a process that has ended and was not waited for."""
        os.kill(self.process.pid, number)

    def reach(self, moment):
        """Waits until the process has used this much CPU time, or has ended."""
        while not self.has_ended():
            if is_handling_signals(self.process) and processor_seconds(self.process) >= moment:
                break
            time.sleep(0.005)

    def wait_until_it_waits(self):
        end = time.monotonic() + SOON
        while not is_handling_signals(self.process) or not is_waiting(self.process):
            if self.has_ended():
                self.test.fail('it ended, and did not wait: %s' % self.finish()[1].err)
            self.test.assertLess(time.monotonic(), end, 'it does not wait')

    # Requirements on every verb.
    def check_files(self, expected=None):
        """Tests that inputs are unchanged, no temporary file is left, and outputs are whole or as before. The
        expected outputs are new, and no others."""
        test = self.test
        for name in self.untouched:
            with open(self.path(name), 'rb') as one, open(os.path.join(self.originals, name), 'rb') as other:
                test.assertTrue(one.read() == other.read(), name + ' is changed')
        there = set(os.listdir(self.folder)) - set(self.example.inputs) - self.others
        test.assertEqual([name for name in there if '.tmp' in name], [])
        there = {name for name in there if not self.is_old(name)}
        if expected is not None:
            test.assertEqual(there - {self.example.report}, set(expected) - {self.example.report})
        for name in there:
            with open(self.path(name), 'rb') as f:
                content = f.read()
            test.assertTrue(content.endswith(ENDS.get(os.path.splitext(name)[1], b'\n')), name + ' is no whole file')

    def check_report(self, code):
        """Tests that codes 2 to 6 have a report with the reason."""
        path = self.path(self.example.report)
        if code < UNREADABLE and (not os.path.exists(path) or self.is_old(self.example.report)):
            return None
        with open(self.path(self.example.report)) as f:
            report = json.load(f)
        self.test.assertEqual((report['schema_version'], report['command']), (2, self.example.verb))
        status = report['status']
        expected = CODES[status]
        if expected == LIMIT and not any(o['written'] for o in report['outputs']):
            expected = INVALID  # stopped before the first result
        if code != USAGE:
            self.test.assertEqual(code, expected, status)
        return report

    def check_one_line(self, done, *parts):
        self.test.assertEqual(done.err.count('\n'), 1, done.err)
        self.test.assertTrue(done.err.startswith('majorant: '), done.err)
        for part in parts:
            self.test.assertIn(part, done.err)


class EveryVerb(CommandTest):
    def for_each(self, check, columns=None, jobs=2):
        """Calls check(Cell or column entry) for every verb, a few at a time; a failing column is a subtest."""
        columns = columns if columns is not None else [(verb,) for verb in VERBS]
        self.assertTrue(columns)
        for verb in {column[0] for column in columns}:  # before threads start
            for size in (SMALL, LARGE) if jobs == 'large' else (SMALL,):
                Inputs.of(size).prepare(*EXAMPLES[verb].inputs)
        with concurrent.futures.ThreadPoolExecutor(2 if jobs == 'large' else jobs) as pool:
            running = [(column, pool.submit(check, EXAMPLES[column[0]], *column[1:])) for column in columns]
        for column, result in running:
            with self.subTest(' '.join(str(getattr(c, 'name', c)) for c in column)):
                result.result()

    # -------------------------------------------------------------- stops
    def check_stopped(self, cell, done, spent, why):
        """Tests the end of a run that was stopped after `spent` CPU seconds; None: perhaps before it began."""
        if done.code < 0:
            self.assertEqual(done.code, -why)
            self.assertIsNone(spent, 'ended by the signal in the middle of the run')
            self.assertEqual(done.printed(), [])
            return cell.check_files([])
        report = cell.check_report(done.code)
        self.assertIn(done.code, (OK, LIMIT, INVALID), done.err)
        lines = [line for line in done.printed() if line.startswith('majorant: ')]
        lines = [line for line in lines if 'a second signal ends at once' not in line]
        if done.code == INVALID and report['status'] == 'undecided':  # a verdict on the findings so far
            self.assertIn(': undecided: ', done.out)
            self.assertEqual(lines, [])
        elif done.code == INVALID:
            self.assertEqual(report['status'], STOPS[why], done.err)
            self.assertEqual(len(lines), 1, done.err)
            self.assertTrue(any(name in lines[0] for name in cell.example.inputs), lines)
            self.assertNotIn('wrote', done.err)
        elif done.code == LIMIT:
            self.assertEqual(report['status'], STOPS[why], done.err)
        else:
            self.assertIn(report['status'], SUCCESSES)
        is_whole = done.code != INVALID or report['status'] == 'undecided'
        cell.check_files(cell.example.writes() if is_whole else [])

    def check_time(self, cell, used, before):
        """Tests the CPU time after the stop, without that of writing."""
        report = cell.check_report(USAGE) or {}
        writing = (report.get('seconds') or {}).get('write', 0)
        self.assertLess(used - before - writing, PATIENCE + ALLOWANCE)

    def stop(self, example, number, moment):
        cell = Cell(self, example, LARGE)
        cell.fill_outputs()
        cell.start(cell.words(more=['--force']))
        cell.reach(moment)
        before = processor_seconds(cell.process)
        cell.send(number)
        used, done = cell.finish()
        self.check_stopped(cell, done, moment or None, number)
        self.check_time(cell, used, before)
        if done.code in (LIMIT, INVALID):
            self.assertIn('majorant: stopping; a second signal ends at once\n', done.err)

    def test_signals_at_once(self):
        self.for_each(self.stop, [(verb, number, 0) for verb in VERBS for number in (signal.SIGINT, signal.SIGTERM)],
                      jobs='large')

    def test_signals_in_the_middle(self):
        self.for_each(self.stop, [(verb, number, moment) for verb in VERBS for number, moment in
                                  ((signal.SIGINT, 0.1), (signal.SIGTERM, 0.4))], jobs='large')

    def test_time_limit(self):
        def check(example):
            cell = Cell(self, example, LARGE)
            cell.start(cell.words(more=['--time-limit', '0.3']))
            used, done = cell.finish()
            self.check_stopped(cell, done, used, None)
            self.check_time(cell, used, 0.3)
        self.for_each(check, [(verb,) for verb in VERBS if EXAMPLES[verb].has_limit], jobs='large')

    # -------------------------------------------------------------- pipes
    def end_waiting(self, cell, number, limit=2):
        """Starts a run that waits, and ends it by a signal or its time limit."""
        cell.start(cell.words(more=['--quiet', *(['--time-limit', str(limit)] if number is None else [])]))
        since = time.monotonic() + limit
        if number is not None:
            cell.wait_until_it_waits()
            since = time.monotonic()
            cell.send(number)
        _, done = cell.finish()
        self.check_waited(since)
        return done

    def check_waited(self, since):
        """Tests that a waiting run ended in time, on a clock that allows for other processes."""
        waited = time.monotonic() - since
        if waited > PATIENCE + ALLOWANCE:
            begun, before = time.monotonic(), os.times()
            majorant('--version')
            used = os.times()
            spent = used.children_user + used.children_system - before.children_user - before.children_system
            slowness = (time.monotonic() - begun) / max(spent, 0.01)
            self.assertLess(waited, (PATIENCE + ALLOWANCE) * max(1, slowness))

    def test_inputs_that_nobody_writes(self):
        def check(example, name, number):
            cell = Cell(self, example)
            os.unlink(cell.path(name))
            os.mkfifo(cell.path(name))
            cell.untouched.remove(name)
            done = self.end_waiting(cell, number)
            self.assertEqual(done.code, INVALID, done.err)
            if number:
                cell.check_one_line(done, 'interrupted while reading %s; nothing is written\n' % name)
            else:  # other inputs are read at the start, which the limit ends as a whole
                cell.check_one_line(done, 'the time limit was reached while ', '; nothing is written\n')
                self.assertTrue(any(n in done.err for n in example.inputs), done.err)
            self.assertEqual(cell.check_report(INVALID)['status'], STOPS[number])
            cell.check_files([])
        self.for_each(check, [(verb, name, number) for verb in VERBS for name in EXAMPLES[verb].inputs
                              for number in STOPS if number or EXAMPLES[verb].limits_run], jobs=12)

    def test_outputs_that_nobody_reads(self):
        def check(example, number):
            cell = Cell(self, example)
            name = example.writes()[0]
            os.mkfifo(cell.path(name))
            cell.others.add(name)
            done = self.end_waiting(cell, number)
            self.assertEqual(done.code, USAGE, done.err)
            rest = set(example.outputs + [example.report]) - {name}
            cell.check_one_line(done, name, 'nobody reads it',
                                *(['written: '] + list(rest) if rest else ['nothing was written']))
            cell.check_files(rest)
        self.for_each(check, [(verb, number) for verb in VERBS for number in STOPS
                              if number or EXAMPLES[verb].limits_run], jobs=12)

    # -------------------------------------------------------------- files that cannot be read or written
    def test_missing_and_invalid_inputs(self):
        def check(example, name, kind):
            cell = Cell(self, example)
            os.unlink(cell.path(name))
            cell.untouched.remove(name)
            if kind == 'folder':
                os.mkdir(cell.path(name))
            elif kind == 'bytes':
                with open(cell.path(name), 'wb') as f:
                    f.write(b'\x00\xffno such format\n')
            cell.fill_outputs()
            done = cell.run(cell.words(more=['--quiet', '--force']))
            self.assertEqual(done.code, UNREADABLE, done.err)
            cell.check_one_line(done, name)
            self.assertEqual(cell.check_report(UNREADABLE)['status'], 'unreadable')
            cell.check_files([])
        self.for_each(check, [(verb, name, kind) for verb in VERBS for name in EXAMPLES[verb].inputs
                              for kind in ('missing', 'folder', 'bytes')])

    def unwritable(self):
        """Returns a folder in which nobody can make a file; root can in others, but not in /proc."""
        if os.geteuid() == 0:
            return '/proc'
        folder = self.path('closed')
        os.makedirs(folder, 0o500, exist_ok=True)
        return folder

    def test_unwritable_folder(self):
        """The output is refused before the work: otherwise the run would wait for its input."""
        def check(example, name):
            cell = Cell(self, example)
            first = example.inputs[0]
            os.unlink(cell.path(first))
            os.mkfifo(cell.path(first))
            cell.untouched.remove(first)
            path = os.path.join(self.unwritable(), name)
            done = cell.run(cell.words(renamed={name: path}))
            self.assertEqual(done.code, USAGE, done.err)
            cell.check_one_line(done, path)
            cell.check_files([])
        self.for_each(check, [(verb, name) for verb in VERBS
                              for name in EXAMPLES[verb].outputs + [EXAMPLES[verb].report]])

    def test_full_device(self):
        def check(example, name):
            cell = Cell(self, example)
            os.symlink('/dev/full', cell.path(name))
            cell.others.add(name)
            self.check_full(cell, cell.run(cell.words(more=['--quiet'])), name)
        self.for_each(check, [(verb, name) for verb in VERBS
                              for name in EXAMPLES[verb].outputs + [EXAMPLES[verb].report]])

    def check_full(self, cell, done, name):
        self.assertEqual(done.code, USAGE, done.err)
        rest = set(cell.example.outputs + [cell.example.report]) - {name}
        cell.check_one_line(done, name, 'No space left',
                            *(['written: '] + list(rest) if rest else ['nothing was written']))
        cell.check_files(rest)
        report = cell.check_report(USAGE) if name != cell.example.report else None
        if report:
            self.assertEqual({o['file']: o['written'] for o in report['outputs']},
                             {o: o != os.path.join('disk', name) and o != name for o in
                              [os.path.join('disk', name) if 'disk' in cell.others else name] +
                              [o for o in cell.example.outputs if o != name]})

    MOUNT = ['unshare', '-m'] if os.geteuid() == 0 else ['unshare', '-rm']

    def test_full_disk(self):
        """A full disk of 64 kB: files can be made, but not filled. Nothing is left on it."""
        if subprocess.run([*self.MOUNT, 'mount', '-t', 'tmpfs', 'tmpfs', self.folder], check=False,
                          stderr=subprocess.DEVNULL).returncode:
            self.skipTest('no mount namespaces')
        script = ('mount -t tmpfs -o size=64k tmpfs disk && { cat /dev/zero >disk/filler 2>/dev/null; '
                  '"$@"; code=$?; ls -A disk >listing; exit $code; }')

        def check(example, name):
            cell = Cell(self, example)
            os.mkdir(cell.path('disk'))
            cell.others |= {'disk', 'listing'}
            done = cell.run(cell.words(renamed={name: os.path.join('disk', name)}, more=['--quiet']),
                            prefix=[*self.MOUNT, 'sh', '-c', script, 'sh'])
            self.check_full(cell, done, name)
            with open(cell.path('listing')) as f:
                self.assertEqual(f.read().split(), ['filler'])
        self.for_each(check, [(verb, EXAMPLES[verb].writes()[-1]) for verb in VERBS])

    def test_stdout_that_takes_nothing(self):
        """stdout carries data, and lost data are an error. Files are still written."""
        def check(example, redirection):
            cell, plain = Cell(self, example), Cell(self, example)
            usual = plain.run(plain.words())
            self.assertEqual(usual.code, OK, usual.err)
            plain.check_files(example.writes())
            done = cell.run(cell.words(), prefix=['sh', '-c', '"$@" ' + redirection, 'sh'])
            self.assertEqual(done.code, USAGE if usual.out else OK, done.err)
            lost = [line for line in done.err.splitlines() if 'standard output' in line]
            self.assertEqual(len(lost), 1 if usual.out else 0, done.err)
            cell.check_files(example.writes())
            self.assertIsNotNone(cell.check_report(done.code))
        self.for_each(check, [(verb, to) for verb in VERBS for to in ('>&-', '>/dev/full')])

    # -------------------------------------------------------------- outputs that are inputs
    def refuse(self, cell, name, target, input_name):
        """An output that is a link to `target` is refused; with --force there is no such message."""
        before = sorted(os.listdir(cell.folder))
        with open(cell.path(target), 'rb') as f:
            content = f.read()
        done = cell.run(cell.words())
        self.assertEqual(done.code, USAGE, done.err)
        cell.check_one_line(done, name, input_name, '--force')
        self.assertEqual(sorted(os.listdir(cell.folder)), before)
        with open(cell.path(target), 'rb') as f:
            self.assertTrue(f.read() == content, target + ' is changed')

    def links(self):
        return [(verb, kind, name, output) for verb in VERBS for kind in ('symlink', 'link')
                for name in EXAMPLES[verb].inputs for output in EXAMPLES[verb].outputs + [EXAMPLES[verb].report]]

    def test_output_is_an_input(self):
        def check(example, kind, name, output):
            cell = Cell(self, example)
            if output in example.inputs:
                return  # the output is the input itself
            if kind == 'symlink':
                os.symlink(name, cell.path(output))
            else:
                os.link(cell.path(name), cell.path(output))
            self.refuse(cell, output, name, name)
        self.for_each(check, self.links())

    def test_output_has_the_name_of_an_input(self):
        def check(example, name, output):
            cell = Cell(self, example)
            done = cell.run(cell.words(renamed={output: name}))
            self.assertEqual(done.code, USAGE, done.err)
            cell.check_one_line(done, name, '--force')
            cell.check_files([])
        self.for_each(check, [(verb, name, output) for verb in VERBS for name in EXAMPLES[verb].inputs
                              for output in EXAMPLES[verb].outputs + [EXAMPLES[verb].report]
                              if os.path.splitext(name)[1] == os.path.splitext(output)[1]])

    def test_output_is_named_by_an_input(self):
        """A material library and its texture; a buffer and an image of glTF; a piece of a PVTU."""
        columns, files = [], {}
        for verb in VERBS:
            for name in EXAMPLES[verb].inputs:
                with open(os.path.join(Inputs.of(SMALL).prepare(name), name), 'rb') as f:
                    for renamed, with_others, targets in naming_others(name, f.read()):
                        files[renamed] = with_others
                        columns += [(verb, name, output, renamed, target)
                                    for output in EXAMPLES[verb].writes() for target in targets]

        def check(example, name, output, renamed, target):
            cell = Cell(self, example)
            os.unlink(cell.path(name))
            for file, content in files[renamed].items():
                with open(cell.path(file), 'wb') as f:
                    f.write(content)
            os.symlink(target, cell.path(output))
            words = [renamed if word == name else word for word in cell.words()]
            cell.words = lambda: words
            self.refuse(cell, output, target, target)
        self.assertEqual({os.path.splitext(column[3])[1] for column in columns}, {'.obj', '.gltf', '.pvtu'})
        self.for_each(check, columns)


if __name__ == '__main__':
    main()
