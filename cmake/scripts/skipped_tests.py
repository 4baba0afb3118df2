#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""skipped_tests.py FILE...: prints a line for each reason for which tests of ctest --output-junit FILE did
not run.

A program with a missing requirement names it on its last line, `skipped: no ...`, and exits with 77. If only
some of its tests do not run, each is a line `skipped TEST: no ...` (tests/main.py and tests/main.cpp); ctest
keeps these lines with --test-output-size-passed 100000.
"""
import re
import sys
import xml.etree.ElementTree


def reasons(trees):
    """Returns {reason: [test, ...]} of the tests that did not run."""
    found = {}
    for case in (case for tree in trees for case in tree.iter('testcase')):
        out, name = case.findtext('system-out') or '', case.get('name')
        if case.find('skipped') is None:
            for test, why in re.findall(r'^skipped (\S+): (.*)$', out, re.M):
                found.setdefault(why, []).append('%s %s' % (name, test))
        else:
            lines = re.findall(r'^skipped: (.*)$', out, re.M)
            found.setdefault(lines[-1] if lines else 'no reason given', []).append(name)
    return found


def main():
    found = reasons(xml.etree.ElementTree.parse(name).getroot() for name in sys.argv[1:])
    print('not run: ' + '; '.join('%s (%s)' % (', '.join(sorted(names)), why)
                                  for why, names in sorted(found.items()))
          if found else 'every test was run')


if __name__ == '__main__':
    sys.exit(main())
