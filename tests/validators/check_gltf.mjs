#!/usr/bin/env node
// Asks the Khronos glTF validator about files.
//
//   node check_gltf.mjs [--json] [--modules DIR] FILE...
//
// DIR is a folder whose node_modules has gltf-validator (default: $GLTF_VALIDATOR_DIR, or target/npm of
// the checkout this script is in). Exit 0: no error and no warning. 1: some. 2: could not check.

import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const SEVERITIES = ["error", "warning", "info", "hint"];

function loadValidator(folder) {
  // The name of the file does not matter, only the folder node starts to look from.
  return createRequire(path.join(path.resolve(folder), "resolve.cjs"))("gltf-validator");
}

async function check(validator, file) {
  const folder = path.dirname(file);
  const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
    uri: path.basename(file),
    maxIssues: 100,
    writeTimestamp: false,
    externalResourceFunction: async (uri) =>
      new Uint8Array(await readFile(path.join(folder, decodeURIComponent(uri)))),
  });
  const { issues, info } = report;
  return {
    file,
    errors: issues.numErrors,
    warnings: issues.numWarnings,
    drawCalls: info?.drawCallCount ?? 0,
    vertices: info?.totalVertexCount ?? 0,
    generator: info?.generator ?? null,
    messages: issues.messages.map(({ code, message, severity, pointer }) => ({
      severity: SEVERITIES[severity],
      code,
      pointer: pointer ?? "",
      message,
    })),
  };
}

function say(report) {
  console.log(`${report.file}: ${report.errors} errors, ${report.warnings} warnings`);
  for (const { severity, code, pointer, message } of report.messages) {
    console.log(`  ${severity} ${code} ${pointer} ${message}`);
  }
}

async function main() {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { json: { type: "boolean", default: false }, modules: { type: "string" } },
  });
  if (positionals.length === 0) {
    throw new Error("no file to check; usage: check_gltf.mjs [--json] [--modules DIR] FILE...");
  }
  const checkout = path.join(path.dirname(fileURLToPath(import.meta.url)), "../..");
  const validator = loadValidator(
    values.modules ?? process.env.GLTF_VALIDATOR_DIR ?? path.join(checkout, "target/npm"),
  );
  const reports = [];
  for (const file of positionals) {
    reports.push(await check(validator, file));
  }
  if (values.json) {
    console.log(JSON.stringify(reports, null, 1));
  } else {
    reports.forEach(say);
  }
  return reports.some(({ errors, warnings }) => errors + warnings > 0) ? 1 : 0;
}

try {
  process.exitCode = await main();
} catch (error) {
  console.error(`error: ${error.message}`);
  process.exitCode = 2;
}
