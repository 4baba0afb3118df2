#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Runs: callbacks, limits, Ctrl-C, threads, memory."""
import gc
import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import threading
import time

import helpers
import numpy as np
import pytest

import majorant

V, F = helpers.grid(12)


class Mine(Exception):
    pass


def solved(_):
    return majorant.parametrize(*helpers.grid(40), degree=2, max_iterations=3, threads=2).uv.tobytes()


def test_forked_children_after_use():
    """Children do not have the parent's threads; results have the same bits."""
    here = solved(None)
    with multiprocessing.get_context('fork').Pool(2) as pool:
        assert pool.map_async(solved, range(4)).get(timeout=60) == [here] * 4


def test_callback_sees_every_step():
    steps = []
    r = majorant.parametrize(V, F, degree=2, callback=steps.append)
    rows = r.report['iterations']
    assert [s.iteration for s in steps] == [row['iteration'] for row in rows]
    assert [s.energy for s in steps] == [row['energy'] for row in rows]
    assert {s.degree for s in steps} == {1, 2} and 'Step(iteration=1' in repr(steps[0])
    for name in ('level', 'phase', 'outcome', 'relative_decrease', 'step', 'step_bound', 'gradient_norm',
                 'newton_decrement', 'elapsed'):
        assert getattr(steps[0], name) is not None


def test_callback_ends_a_run():
    r = majorant.parametrize(V, F, degree=2, callback=lambda step: step.iteration >= 2)
    assert r.status == 'interrupted' and len(r.report['iterations']) == 2
    steps = []
    r = majorant.unwrap(V, F, degree=2, callback=steps.append)
    assert len(steps) == 1      # the only chart is small
    assert steps[0].energy == pytest.approx(r.report['result']['value'], rel=1e-4)
    with pytest.raises(majorant.StoppedError):
        majorant.unwrap(*helpers.grid(60), degree=2, callback=lambda step: True)
    r = majorant.unwrap(*helpers.grid(60), degree=2, callback=lambda step: step.level == 0, pack=False)
    assert r.status == 'interrupted' and majorant.check(r)


@pytest.mark.parametrize('solver', [majorant.parametrize, majorant.seamless, majorant.unwrap, majorant.deform])
def test_exceptions_of_callbacks_are_passed_on(solver):
    mine = Mine('as it was')

    def callback(step):
        raise mine

    flat = np.column_stack([V[:, :2], 0 * V[:, 2]])
    with pytest.raises(Mine) as raised:
        solver(flat if solver is majorant.deform else V, F, callback=callback,
               **({'handles': {0: (-1, -1)}} if solver is majorant.deform else {}))
    assert raised.value is mine
    assert raised.traceback[-1].name == 'callback'


def test_limits_return_the_best_map():
    r = majorant.parametrize(V, F, degree=3, max_iterations=1)
    assert r.status == 'max_iterations' and majorant.check(r, V, F)
    r = majorant.parametrize(V, F, degree=3, time_limit=0)
    assert r.status == 'time_limit' and majorant.check(r, V, F)


def test_a_run_in_a_callback():
    inner = []

    def callback(step):
        if not inner:
            inner.append(majorant.flatten(V, F))

    outer = majorant.parametrize(V, F, degree=1, callback=callback)
    assert np.array_equal(inner[0], outer.uv)


def test_other_threads_run_meanwhile():
    ticks, ends = [], threading.Event()

    def tick():
        while not ends.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    big = helpers.grid(60)
    majorant.parametrize(*big, degree=2, threads=1)
    end = time.perf_counter()
    ends.set()
    thread.join()
    during = [t for t in ticks if start < t < end]
    assert len(during) > 10 * (end - start), (len(during), end - start)


def test_two_threads_and_one_give_the_same_bits():
    jobs = [dict(degree=2), dict(degree=3, energy='arap + 0.1*symmetric-dirichlet'), dict(degree=1, bijective=True)]
    serial = [majorant.parametrize(V, F, **job).control_points for job in jobs]
    found = [None] * len(jobs)

    def solve(k):
        found[k] = majorant.parametrize(V, F, callback=lambda step: None, **jobs[k]).control_points

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(len(jobs))]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    for one, other in zip(serial, found):
        assert np.array_equal(one, other)
    for count in (1, 2):
        assert np.array_equal(majorant.parametrize(V, F, degree=2, threads=count).control_points, serial[0])


INTERRUPTED = '''
import sys, time, signal, threading
sys.path.insert(0, {tests!r})
import helpers, majorant
V, F = helpers.grid(150)
{before}
print('go', flush=True)
start = time.perf_counter()
try:
    r = {call}
    print('returned', r.status, flush=True)
except KeyboardInterrupt:
    print('KeyboardInterrupt', flush=True)
print('usable', majorant.flatten(*helpers.grid(3)).shape, flush=True)
assert signal.getsignal(signal.SIGINT) is {handler}
'''


def interrupt(call, before='', handler='signal.default_int_handler', delay=0.5):
    script = INTERRUPTED.format(tests=str(helpers.SOURCE / 'tests/python'), call=call, before=before, handler=handler)
    process = subprocess.Popen([sys.executable, '-c', script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               text=True, env=helpers.environment())
    assert process.stdout.readline() == 'go\n', process.communicate()[1]
    time.sleep(delay)
    sent = time.perf_counter()
    process.send_signal(signal.SIGINT)
    first = process.stdout.readline()
    waited = time.perf_counter() - sent
    rest, errors = process.stdout.read(), process.stderr.read()  # communicate() loses what readline() read ahead
    process.wait()
    assert process.returncode == 0, errors
    assert rest == 'usable (16, 2)\n'
    return first, waited


@pytest.mark.parametrize('call', [
    'majorant.parametrize(V, F, degree=8)',
    'majorant.parametrize(V, F, degree=8, callback=lambda step: None)',
    'majorant.seamless(V, F, degree=8)',
])
def test_ctrl_c_raises_keyboard_interrupt(call):
    printed, waited = interrupt(call)
    assert printed == 'KeyboardInterrupt\n' and waited < 10


@pytest.mark.parametrize('degree', [1, 3])
def test_ctrl_c_ends_a_run_within_an_iteration(degree):
    times, sent = [], []

    def send():
        while len(times) < 2:
            time.sleep(1e-3)
        time.sleep(0.6 * (times[1] - times[0]))
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=send)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        majorant.parametrize(*helpers.grid(100), degree=degree, init='tutte', elevation='direct',
                             callback=lambda step: times.append(time.perf_counter()))
    end = time.perf_counter()
    thread.join()
    assert sum(t > sent[0] for t in times) <= 1
    assert end - sent[0] < 0.5 + 2 * max(b - a for a, b in zip(times, times[1:]))


def test_runs_stopped_before_a_map_exists():
    with pytest.raises(majorant.StoppedError, match='interrupted before there was a result') as raised:
        majorant.parametrize(*helpers.grid(60), init='multiresolution', callback=lambda step: step.level > 0)
    assert raised.value.exit_code == 5


def test_a_handler_that_raises_nothing():
    printed, _ = interrupt('majorant.parametrize(V, F, degree=8)', 'def quiet(*_): pass\nsignal.signal(signal.SIGINT, quiet)',
                        handler='quiet', delay=3)
    assert printed == 'returned interrupted\n'


def test_memory_is_steady():
    mesh = helpers.grid(8)
    density = majorant.Density('dirichlet', lambda J: 0.5 * (J ** 2).sum((1, 2)),
                               lambda J: (J, np.broadcast_to(np.eye(4), (len(J), 4, 4))), domain='everywhere',
                               free_scale='collapses')

    def work(times):
        for k in range(times):
            r = majorant.parametrize(*mesh, degree=2, callback=lambda step: None)
            r.evaluate(0, [0.2, 0.3, 0.5]), r.report, r.uv, r.svg()
            if k % 20 == 0:
                majorant.flatten(*mesh, energy=density, boundary='fixed')
                majorant.check(r)
                with pytest.raises(Mine):
                    majorant.flatten(*mesh, callback=raise_mine)

    def raise_mine(step):
        raise Mine

    def resident():
        gc.collect()
        with open('/proc/self/statm') as file:
            return int(file.read().split()[1]) * resource.getpagesize()

    work(60)
    before = resident()
    work(250)
    # A leak of one map per run, 20 kB, would add 5 MB.
    assert resident() - before < 1.5e6


if __name__ == '__main__':
    helpers.main(__file__)
