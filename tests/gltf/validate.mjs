// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
// node validate.mjs LIST.json: what Khronos' glTF Validator says of the files that the list names,
// on stdout: [[{code, pointer, severity, message}]].
import {readFileSync} from 'node:fs';
import {dirname, join} from 'node:path';
import validator from 'gltf-validator';

const answers = [];
for (const file of JSON.parse(readFileSync(process.argv[2], 'utf8'))) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: file,
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
  });
  answers.push(report.issues.messages);
}
process.stdout.write(JSON.stringify(answers));
