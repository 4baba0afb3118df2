#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Every ```python block of docs/ is a complete program that runs without errors."""
import re
import subprocess
import sys

import helpers
import pytest

PAGE = (helpers.SOURCE / 'docs/python.md').read_text()
EXAMPLES = re.findall(r'^```python\n(.*?)^```', PAGE, re.S | re.M)
TUTORIALS = [text for page in sorted((helpers.SOURCE / 'docs').glob('*.md')) if page.name != 'python.md'
             for text in re.findall(r'^```python\n(.*?)^```', page.read_text(), re.S | re.M)]


def test_there_are_thirteen():
    assert len(EXAMPLES) == 13 and PAGE.count('```python') == 13 and 'Each of the thirteen examples' in PAGE
    assert TUTORIALS


@pytest.mark.parametrize('text', EXAMPLES + TUTORIALS, ids=[str(k) for k in range(len(EXAMPLES + TUTORIALS))])
def test_runs(text, tmp_path):
    if 'matplotlib' in text:
        pytest.importorskip('matplotlib')
    (tmp_path / 'examples').symlink_to(helpers.SOURCE / 'examples')
    done = subprocess.run([sys.executable, '-W', 'error', '-c', text], cwd=tmp_path, env=helpers.environment(),
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


if __name__ == '__main__':
    helpers.main(__file__)
