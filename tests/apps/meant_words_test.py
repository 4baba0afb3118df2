# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""What is said to a command line that is nearly right: verbs, options, choices, help."""
import os
import unittest

from command_helpers import *


class MeantWords(CommandTest):
    def said(self, *args):
        return self.refused(USAGE, *args).err

    def test_verbs(self):
        for wrong, right in [('parametrise', 'parametrize'), ('param', 'parametrize'),
                             ('chek', 'check'), ('verify', 'check'), ('inof', 'info')]:
            self.assertIn("did you mean '%s' (see majorant %s --help)?" % (right, right),
                          self.said(wrong, 'x.obj'), wrong)
        self.assertRegex(self.said('frobnicate', 'x'), 'use one of parametrize, unwrap, seamless, .*info')
        self.assertRegex(self.said('flatten', 'x.obj'), "no verb is called 'flatten'")
        self.assertRegex(self.said('--quiet'), 'name a verb: one of parametrize, ')
        for option in (['-q'], ['--quiet'], ['--threads', '2'], ['-o', 'x.obj']):
            self.assertIn("'%s' comes after the verb: majorant unwrap ... %s (see majorant unwrap --help)"
                          % (option[0], option[0]), self.said(*option, 'unwrap', 'x.obj'))

    def test_options(self):
        mesh = generated('cap')
        run = ['parametrize', mesh, '-o', self.path('out.vtu')]
        for wrong, right in [('--bijectiv', '--bijective'), ('--degre=2', '--degree'),
                             ('--max-iter', '--max-iterations'), ('--tolerence', '--tolerance')]:
            err = self.said(*run, wrong)
            self.assertIn("parametrize has no option '%s' (did you mean '%s'?) (see majorant "
                          'parametrize --help)' % (wrong.split('=')[0], right), err)
        # Its value is not taken for something else.
        self.assertIn("did you mean '--tolerance'",
                      self.said('parametrize', '--tolerence', '1e-5', mesh, self.path('o.obj')))
        self.assertIn("seamless has no option '--init', parametrize, compare has",
                      self.said('seamless', mesh, '-o', self.path('out.vtu'), '--init', 'tutte'))
        self.assertRegex(self.said(*run, '--frobnicate'), r"'--frobnicate' \(see majorant param")
        self.assertIn("one word too many: 'c.obj' (see majorant info --help)",
                      self.said('info', mesh, 'c.obj'))
        self.assertIn('input is required (see majorant info --help)', self.said('info'))

    def test_options_by_their_names_elsewhere(self):
        mesh = generated('cap')
        for verb, wrong, right in [('unwrap', '--margin', '--padding'), ('unwrap', '--texture-size', '--resolution'),
                                   ('unwrap', '--texture-resolution=512', '--resolution'),
                                   ('unwrap', '--max-charts', '--charts'), ('unwrap', '-j', '--threads'),
                                   ('parametrize', '--order', '--degree'), ('bake', '--texture-size', '--size'),
                                   ('bake', '--margin', '--padding')]:
            run = [verb, mesh, '-o', self.path('o.png'), *(['--from', mesh] if verb == 'bake' else [])]
            self.assertIn("%s has no option '%s' (did you mean '%s'?)" % (verb, wrong.split('=')[0], right),
                          self.said(*run, wrong))
        # Of the verb alone.
        self.assertNotIn('--padding', self.said('check', mesh, '--margin', '4'))

    def test_a_size_of_pictures_and_one_of_textures(self):
        mesh = generated('cap')
        self.assertIn('or leave out --size (that of a texture for the layout is --resolution)',
                      self.said('unwrap', mesh, '-o', self.path('o.obj'), '--size', 512))
        self.assertNotIn('--resolution', self.said('parametrize', mesh, '-o', self.path('o.obj'), '--size', 512))
        for wrong in ('15', '8193', '10,20', '99.5', '20,20,20', '20,'):
            self.assertIn("'%s' is no size; give pixels, 16 to 8192: 1000, a square, or 1000,800" % wrong,
                          self.said('parametrize', mesh, '-o', self.path('o.png'), '--size', wrong))

    def test_padding_that_leaves_no_room(self):
        run = ['unwrap', generated('cap'), '-o', self.path('o.obj')]
        for padding, resolution in ((600, 1024), (512, 1024), (1, 2)):
            self.assertIn('--padding %d: on both sides of the layout it takes all of the %d pixels of --resolution'
                          % (padding, resolution),
                          self.said(*run, '--padding', padding, '--resolution', resolution))
        self.run_ok(*run, '--padding', 100, '--resolution', 1024, '--quiet')

    def test_choices(self):
        run = ['parametrize', generated('cap'), '-o', self.path('out.vtu')]
        for option, wrong, right in [('--boundary', 'fixd', 'fixed'), ('--init', 'tute', 'tutte'),
                                     ('--curvature', 'proj', 'projected'),
                                     ('--elevation', 'incremetnal', 'incremental'),
                                     ('--energy', 'arpa', 'arap'), ('--energy', 'sym', 'symm')]:
            self.assertIn("(did you mean '%s" % right, self.said(*run, option, wrong))
        self.assertNotIn('did you mean', self.said(*run, '--boundary', 'loose'))
        self.assertIn("did you mean 'newton'",
                      self.said('compare', generated('cap'), '--methods', 'newtn'))

    def test_numbers(self):
        mesh = generated('cap')
        run = ['parametrize', mesh, '-o', self.path('out.vtu')]
        for option, value, wanted in [('--degree', '3.0', 'whole number from 1 to 8'),
                                      ('--degree', '9', 'whole number from 1 to 8'),
                                      ('--degree', '1e0', 'whole number from 1 to 8'),
                                      ('--max-iterations', '2.5', 'whole number from 0 on'),
                                      ('--threads', '99999999999', 'whole number from 1 to 1024'),
                                      ('--quadrature', '0', 'whole number from 1 to 10000')]:
            self.assertIn("%s: '%s' is no %s" % (option, value, wanted), self.said(*run, option, value))

    def test_seams_that_are_nearly_a_word(self):
        for verb in ('unwrap', 'parametrize'):
            for wrong, right in [('sharpp', 'sharp'), ('uv2', 'uv'), ('atuo', 'auto')]:
                self.assertIn("there is no file '%s' (did you mean '%s'?)" % (wrong, right),
                              self.said(verb, generated('cap'), '-o', self.path('o.obj'), '--seams', wrong))
        self.refused(UNREADABLE, 'unwrap', generated('cap'), '-o', self.path('o.obj'), '--seams', 'no.json',
                     says='no.json')
        self.write('uw', '{"edges": []}')
        outcome = majorant('unwrap', generated('cap'), '-o', self.path('o.obj'), '--seams', 'uw', '--quiet',
                           cwd=self.folder)
        self.assertEqual(outcome.code, OK, outcome.err)

    def test_formats_that_are_not_read(self):
        for args, name in [(['x.fbx', 'd.obj'], 'FBX'), (['model.3mf', '-o', 'd.obj'], '3MF'),
                           (['unwrap', 'x.FBX', '-o', 'd.obj'], 'FBX'), (['info', 'x.dae'], 'COLLADA'),
                           (['check', 'x.3ds'], '3DS'), (['parametrize', 'x.usdz', 'd.obj'], 'USD'),
                           (['convert', 'x.blend', 'd.obj'], 'Blender')]:
            self.refused(UNSUPPORTED, *args, says='%s files are not read; export the mesh as .obj' % name)

    def test_help(self):
        self.assertEqual(self.run_ok('help').out, self.run_ok('--help').out)
        self.assertEqual(self.run_ok('help', 'check').out, self.run_ok('check', '--help').out)
        self.assertIn("did you mean 'check'", self.said('help', 'chek'))

    def test_a_file_without_a_verb(self):
        """Means unwrap, where there is that verb."""
        unwraps = 'unwrap' in self.run_ok('--help').out
        for args in [(generated('cap'), self.path('out.obj')), ('absent.obj.gz', 'out.obj'),
                     ('-o', self.path('out.svg'), generated('cap'))]:
            outcome = majorant(*args)
            if unwraps:
                self.assertEqual(outcome.code, UNREADABLE if 'absent' in args[0] else OK, args)
            else:
                self.assertEqual(outcome.code, USAGE)
                self.assertRegex(outcome.err, 'is a file; name a verb first')


if __name__ == '__main__':
    main()
