/**
 * A reporter of vitest: writes how long each file took, in milliseconds, by its project, what work it
 * counted, and which tests failed and why.
 */
import { writeFileSync } from "node:fs";

export default class TestSummary {
  onTestRunEnd(modules, unhandledErrors) {
    const files = [];
    const failures = [];
    const fail = (name, errors) => failures.push({ name, messages: errors.map(messageOf) });
    for (const module of modules) {
      files.push({
        project: module.project.name,
        name: module.relativeModuleId,
        tests: [...module.children.allTests()].length,
        milliseconds: module.diagnostic().duration,
        work: module.meta().work,
      });
      // Errors outside of tests: of an import, or of what runs before and after all.
      for (const suite of [module, ...module.children.allSuites()]) {
        if (suite.errors().length > 0) fail(nameOf(module, suite), suite.errors());
      }
      for (const test of module.children.allTests("failed")) {
        fail(nameOf(module, test), test.result().errors);
      }
    }
    if (unhandledErrors.length > 0) fail("outside of any test", unhandledErrors);
    const path = process.env.TURNLEAF_TEST_SUMMARY;
    if (path) writeFileSync(path, JSON.stringify({ files, failures }));
  }
}

const nameOf = (module, { fullName }) =>
  [module.project.name, module.relativeModuleId, fullName].filter(Boolean).join(" > ");

/** Characters of an error that are kept: a picture's difference may have millions. */
const mostCharacters = 2000;

const messageOf = ({ message, diff }) =>
  [message, diff].filter(Boolean).join("\n").slice(0, mostCharacters);
