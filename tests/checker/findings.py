# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""The findings of the checks, and the verdict that follows from them."""


class Findings:
    """The findings about one file. bad(word, text): the file is wrong; undecided(word, text): exact
    arithmetic reached its limits; note(key, value): a count for the summary. A word is one of WORDS."""

    WORDS = ('vertices', 'manifold', 'orientation', 'coverage', 'flatness', 'positivity',
             'continuity', 'angles', 'overlap', 'touching')

    def __init__(self):
        self.violations, self.open_questions, self.notes = {}, {}, {}

    def bad(self, word, text):
        assert word in self.WORDS
        self.violations.setdefault(word, []).append(text)

    def undecided(self, word, text):
        assert word in self.WORDS
        self.open_questions.setdefault(word, []).append(text)

    def note(self, key, value):
        self.notes[key] = value

    @property
    def verdict(self):
        return 'bad' if self.violations else 'undecided' if self.open_questions else 'ok'

    def summary(self):
        """Returns one line: the verdict, each word with its count and first example, and the notes."""
        found = self.violations or self.open_questions
        parts = ['%s (%d): %s' % (word, len(found[word]), found[word][0])
                 for word in self.WORDS if word in found]
        parts += ['%s %s' % (key, value) for key, value in self.notes.items()]
        return self.verdict + ' ' + '; '.join(parts)

    def report(self):
        return {'verdict': self.verdict, 'violations': self.violations,
                'undecided': self.open_questions, 'notes': self.notes}
