# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause
"""Messages for command lines with typing errors: verbs, options, choices, help."""
import os
import unittest

from command_helpers import *


class MeantWords(CommandTest):
    def printed(self, *args):
        return self.refused(USAGE, *args).err

    def test_verbs(self):
        for wrong, right in [('parametrise', 'parametrize'), ('param', 'parametrize'),
                             ('chek', 'check'), ('verify', 'check'), ('inof', 'info')]:
            self.assertIn("did you mean '%s' (see majorant %s --help)?" % (right, right),
                          self.printed(wrong, 'x.obj'), wrong)
        self.assertRegex(self.printed('frobnicate', 'x'),
                         "no verb and no file is called 'frobnicate'; use one of parametrize, .*info, mesh check")
        self.assertIn("did you mean 'parametrize'", self.printed('PARAMETRIZE', 'x.obj'))
        self.assertIn("did you mean 'mesh optimize'", self.printed('optimize', 'x.msh'))
        self.assertRegex(self.printed('flatten', 'x.obj'), "no verb is called 'flatten'")
        self.assertRegex(self.printed('--quiet'), 'name a verb: one of parametrize, ')
        for option in (['-q'], ['--quiet'], ['--threads', '2'], ['-o', 'x.obj']):
            self.assertIn("'%s' comes after the verb: majorant unwrap ... %s (see majorant unwrap --help)"
                          % (option[0], option[0]), self.printed(*option, 'unwrap', 'x.obj'))
        self.assertIn('majorant mesh check ... -q (see', self.printed('-q', 'mesh', 'check', 'x.msh'))
        self.assertIn("check has no option '--degree'; parametrize,", self.printed('--degree', '3', 'check', 'x.vtu'))

    def test_verbs_of_a_group(self):
        for words, says in [(['mesh'], 'name a verb: one of mesh check, mesh optimize (see majorant mesh --help)'),
                            (['mesh', 'chek', 'x.msh'], "no verb is called 'mesh chek'; did you mean 'mesh check'"),
                            (['mesh', 'foo', 'x.msh'], "no verb and no file is called 'mesh foo'; use one of "),
                            (['mesh', 'x.msh'], "'x.msh' is a file; name a verb first, as in majorant mesh check"),
                            (['mesh', 'check', 'x.msh', '--target', 'ideal'],
                             "mesh check has no option '--target'; mesh optimize has it")]:
            self.assertIn(says, self.printed(*words))

    def test_options_of_the_program(self):
        for wrong, right in [('--halp', '--help'), ('--licences', '--licenses'), ('--versoin', '--version')]:
            self.assertIn("majorant has no option '%s' (did you mean '%s'?) (see majorant --help)" % (wrong, right),
                          self.printed(wrong))

    def test_options(self):
        mesh = generated('cap')
        run = ['parametrize', mesh, '-o', self.path('out.vtu')]
        for wrong, right in [('--bijectiv', '--bijective'), ('--degre=2', '--degree'),
                             ('--max-iter', '--max-iterations'), ('--tolerence', '--tolerance')]:
            err = self.printed(*run, wrong)
            self.assertIn("parametrize has no option '%s' (did you mean '%s'?) (see majorant "
                          'parametrize --help)' % (wrong.split('=')[0], right), err)
        # The value of the unknown option is not taken for another argument.
        self.assertIn("did you mean '--tolerance'",
                      self.printed('parametrize', '--tolerence', '1e-5', mesh, self.path('o.obj')))
        self.assertIn("seamless has no option '--init'; parametrize and compare have it (see majorant",
                      self.printed('seamless', mesh, '-o', self.path('out.vtu'), '--init', 'tutte'))
        self.assertIn("info has no option '--certify'; check has it", self.printed('info', mesh, '--certify'))
        self.assertIn("did you mean '--output'", self.printed(*run, '--out', 'x.obj'))
        self.assertRegex(self.printed(*run, '--frobnicate'), r"'--frobnicate' \(see majorant param")
        self.assertIn("one word too many: 'c.obj' (see majorant info --help)",
                      self.printed('info', mesh, 'c.obj'))
        self.assertIn('input is required (see majorant info --help)', self.printed('info'))

    def test_options_by_their_names_elsewhere(self):
        mesh = generated('cap')
        for verb, wrong, right in [('unwrap', '--margin', '--padding'), ('unwrap', '--texture-size', '--resolution'),
                                   ('unwrap', '--texture-resolution=512', '--resolution'),
                                   ('unwrap', '--max-charts', '--charts'), ('unwrap', '-j', '--threads'),
                                   ('parametrize', '--order', '--degree'), ('bake', '--texture-size', '--size'),
                                   ('bake', '--margin', '--padding')]:
            run = [verb, mesh, '-o', self.path('o.png'), *(['--from', mesh] if verb == 'bake' else [])]
            self.assertIn("%s has no option '%s' (did you mean '%s'?)" % (verb, wrong.split('=')[0], right),
                          self.printed(*run, wrong))
        # Only options of the verb are suggested.
        self.assertNotIn('--padding', self.printed('check', mesh, '--margin', '4'))

    def test_a_size_of_pictures_and_one_of_textures(self):
        mesh = generated('cap')
        self.assertIn('or leave out --size (that of a texture for the layout is --resolution)',
                      self.printed('unwrap', mesh, '-o', self.path('o.obj'), '--size', 512))
        self.assertNotIn('--resolution', self.printed('parametrize', mesh, '-o', self.path('o.obj'), '--size', 512))
        for wrong in ('15', '8193', '10,20', '99.5', '20,20,20', '20,'):
            self.assertIn("'%s' is not a size; give one or two numbers of pixels, 16 to 8192: 1000 (a square) or 1000,800" % wrong,
                          self.printed('parametrize', mesh, '-o', self.path('o.png'), '--size', wrong))

    def test_padding_that_leaves_no_room(self):
        run = ['unwrap', generated('cap'), '-o', self.path('o.obj')]
        for padding, resolution in ((600, 1024), (512, 1024), (1, 2)):
            self.assertIn('--padding %d: twice this leaves nothing of the %d pixels of --resolution'
                          % (padding, resolution),
                          self.printed(*run, '--padding', padding, '--resolution', resolution))
        self.run_ok(*run, '--padding', 100, '--resolution', 1024, '--quiet')

    def test_choices(self):
        run = ['parametrize', generated('cap'), '-o', self.path('out.vtu')]
        for option, wrong, right in [('--boundary', 'fixd', 'fixed'), ('--init', 'tute', 'tutte'),
                                     ('--curvature', 'proj', 'projected'),
                                     ('--elevation', 'incremetnal', 'incremental'),
                                     ('--energy', 'arpa', 'arap'), ('--energy', 'sym', 'symm')]:
            self.assertIn("(did you mean '%s" % right, self.printed(*run, option, wrong))
        self.assertNotIn('did you mean', self.printed(*run, '--boundary', 'loose'))
        self.assertIn("did you mean 'newton'",
                      self.printed('compare', generated('cap'), '--methods', 'newtn'))

    def test_numbers(self):
        mesh = generated('cap')
        run = ['parametrize', mesh, '-o', self.path('out.vtu')]
        for option, value, required in [('--degree', '3.0', 'whole number from 1 to 8'),
                                      ('--degree', '9', 'whole number from 1 to 8'),
                                      ('--degree', '1e0', 'whole number from 1 to 8'),
                                      ('--degree', '0x3', 'whole number from 1 to 8'),
                                      ('--max-iterations', '2.5', 'whole number from 0 on'),
                                      ('--threads', '99999999999', 'whole number from 1 to 1024'),
                                      ('--quadrature', '0', 'whole number from 1 to 10000')]:
            self.assertIn("%s: '%s' is not a %s" % (option, value, required), self.printed(*run, option, value))

    def test_values_that_are_missing_empty_or_given_twice(self):
        run = ['parametrize', generated('cap'), '-o', self.path('out.vtu')]
        for words, says in [(['--degree'], '--degree: its value is missing; write --degree N, from 1 to 8 (see'),
                            (['--degree='], '--degree: its value is missing; write --degree N, from 1 to 8'),
                            (['--boundary'], '--boundary: its value is missing; write --boundary free|fixed'),
                            (['--pins'], '--pins: its value is missing; write --pins FILE'),
                            (['--pins', '--quiet'], '--pins: its value is missing; write --pins FILE'),
                            (['-o'], '--output: its value is missing; write --output FILE'),
                            (['--pins', ''], '--pins: its value is empty; give one, or leave it out'),
                            (['--report', ''], '--report: its value is empty'), (['-o', ''], '--output: its value'),
                            ([''], 'output: its value is empty'),
                            (['--degree', 2, '--degree', 3], '--degree is given 2 times; give it once'),
                            (['-q', '-v'], '--quiet excludes --verbose; leave one of the two out')]:
            with self.subTest(words):
                self.assertIn(says, self.printed(*run, *words))
                self.assertEqual(self.files(), [])
        self.assertIn('the first word is empty; name a verb or a file', self.printed('', 'out.obj'))
        self.refused(UNREADABLE, 'info', '', says="'': no file has an empty name")
        self.run_ok(*run, '--view', '--grid', '-o', self.path('out.png'), '-q')  # the values of these options are optional

    def test_seams_that_are_nearly_a_word(self):
        for verb in ('unwrap', 'parametrize'):
            run = [verb, generated('cap'), '-o', self.path('o.obj')]
            for words in (['--seams', 'sharp', 40], ['--seams=sharp', 40]):
                self.assertIn('--seams sharp 40: the number belongs to the word; write --seams sharp=40 (see',
                              self.printed(*run, *words))
                self.assertIn('write --seams sharp=40', self.printed(verb, generated('cap'), *words, '-o', 'o.obj'))
            for wrong in ('40', 'sharp40', 'sharp:40'):
                self.assertIn("there is no file '%s'; write --seams sharp=40 for an angle" % wrong,
                              self.printed(*run, '--seams', wrong))
            for wrong, right in [('sharpp', 'sharp'), ('uv2', 'uv'), ('atuo', 'auto'), ('UV', 'uv')]:
                self.assertIn("there is no file '%s' (did you mean '%s'?)" % (wrong, right),
                              self.printed(verb, generated('cap'), '-o', self.path('o.obj'), '--seams', wrong))
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
        self.assertIn("did you mean 'check'", self.printed('help', 'chek'))
        self.assertIn("no verb and no file is called 'nothing'", self.printed('help', 'nothing'))
        self.assertEqual(self.run_ok('help', 'mesh', 'check').out, self.run_ok('mesh', 'check', '--help').out)
        self.assertIn("did you mean 'mesh check'", self.printed('help', 'mesh', 'chek'))
        self.assertIn("one word too many: 'convert'", self.printed('help', 'check', 'convert'))

    def test_version(self):
        self.assertEqual(self.run_ok('version').out, self.run_ok('--version').out)
        self.assertEqual(self.run_ok('licenses').out, self.run_ok('--licenses').out)
        self.assertEqual(self.run_ok('help', 'version').out, self.run_ok('--help').out)

    def test_a_file_without_a_verb(self):
        """A file without a verb means unwrap."""
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
