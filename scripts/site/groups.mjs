/** The pages of the site by group, in the order of its navigation: files of the repository. */
export const groups = {
  "Turnleaf is for": {
    "people who read": "docs/for/readers.md",
    "web developers": "docs/for/web-developers.md",
    "libraries and museums": "docs/for/libraries.md",
    "motion designers": "docs/for/motion-designers.md",
    "students of the method": "docs/for/students.md",
  },
  Guide: {
    "In short": "README.md",
    "Where to begin": "docs/README.md",
    Examples: "examples/index.html",
    Reference: "docs/reference.md",
    "What opens": "docs/sources.md",
    "In a framework": "docs/frameworks.md",
    "Without a build": "docs/script-tag.md",
    "Pages that are HTML": "docs/html-pages.md",
    "From page-flip": "docs/page-flip.md",
    "From turn.js": "docs/turn-js.md",
    "From dFlip": "docs/dflip.md",
    "Sources of your own": "docs/page-source.md",
    Publishing: "docs/publish.md",
    "The command": "packages/cli/README.md",
    "Key frames": "docs/keyframes.md",
    "File formats": "docs/formats.md",
    Browsers: "docs/browsers.md",
    Policy: "docs/policy.md",
    Trouble: "docs/trouble.md",
    Requests: "docs/requests.md",
  },
  Method: {
    "Ways of turning": "docs/methods.md",
    Physics: "docs/physics.md",
    Folding: "docs/folding.md",
    Performance: "docs/performance.md",
    Playground: "docs/playground.md",
    Glossary: "docs/glossary.md",
  },
  "How it is built": {
    Architecture: "docs/architecture.md",
    Decisions: "docs/decisions",
    Reports: "docs/reports",
    Contributing: "CONTRIBUTING.md",
    Security: "SECURITY.md",
    Changes: "CHANGELOG.md",
  },
};

/**
 * Returns the groups with a last one for pages of docs/ that are in none.
 *
 * @param files the Markdown files of docs/, by their path in the repository
 */
export function groupsWith(files) {
  const known = new Set(Object.values(groups).flatMap((group) => Object.values(group)));
  const others = files.filter((file) => !known.has(file));
  if (others.length === 0) return groups;
  const named = others.map((file) => [
    file.replace(/^docs\/|\.md$/g, "").replaceAll("-", " "),
    file,
  ]);
  return { ...groups, More: Object.fromEntries(named) };
}
