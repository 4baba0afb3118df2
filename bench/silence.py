#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""How long a run of the command says nothing: the lines of its log with the times at which they arrive.

Sample run:
    bench/silence.py /tmp/log.txt build/release/apps/majorant big.obj out.obj -o big.html

Writes the lines with their seconds to the file, and prints by activity the longest silence, how often the
share changed and the longest time that it stood still, what went backwards, and the exit code.
"""
import re
import subprocess
import sys
import time

WHERE = re.compile(r'(\d+) of (\d+) (\w+)(?: (\d+) %)?.*?  ((?:\d+:)?\d+:\d\d)(?:,[^,]*?left)?(?:  pass (\d+))?')
OVER = re.compile(r'(\w+) +\d+\.\d\d s$')


def seconds(clock):
    total = 0
    for part in clock.split(':'):
        total = 60 * total + int(part)
    return total


class Silence:
    def __init__(self):
        self.said, self.stages, self.backwards = 0.0, {}, []
        self.activity, self.place, self.shares = None, (0, 0, 1), {}

    def take(self, now, line):
        """A line that arrives now; the gap before it belongs to what it tells of."""
        where, over = WHERE.match(line), OVER.match(line)
        name = where[3] if where else over[1] if over else self.activity or 'solving'
        self.stages[name] = max(self.stages.get(name, 0.0), now - self.said)
        self.said, self.activity = now, name if where else None
        if not where:
            return
        place = int(where[1]), seconds(where[5]), int(where[6] or 1)
        for before, after, what in zip(self.place, place, ('stage', 'clock', 'pass')):
            if after < before:
                self.backwards.append(f'{what}: {line}')
        self.place = place
        if where[4]:
            shares = self.shares.setdefault((place[2], name), [])
            if shares and int(where[4]) < shares[-1][1]:
                self.backwards.append(f'share: {line}')
            shares.append((now, int(where[4])))

    def still(self, name):
        """The longest time between a share and the next one that is larger."""
        longest = 0.0
        for shares in (shares for (_, of), shares in self.shares.items() if of == name):
            since, share = shares[0]
            for now, larger in shares[1:]:
                longest = max(longest, now - since)
                if larger > share:
                    since, share = now, larger
        return longest


def main():
    log, command = sys.argv[1], sys.argv[2:]
    silence, start = Silence(), time.monotonic()
    with open(log, 'w') as out, subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        for line in process.stderr:
            now = time.monotonic() - start
            out.write(f'{now:8.2f}  {line}')
            silence.take(now, line.rstrip('\n'))
    for name, longest in silence.stages.items():
        told = sorted({share for (_, of), all in silence.shares.items() if of == name for _, share in all})
        print(f'{name:10} silent at most {longest:5.2f} s, {len(told)} shares, stood still {silence.still(name):.1f} s')
    print('backwards:', silence.backwards or 'nothing')
    print(f'exit {process.returncode}, {time.monotonic() - start:.1f} s')


if __name__ == '__main__':
    main()
