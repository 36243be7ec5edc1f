/** What is known of tests that no program judges here: what does not apply, what is missing, what was seen. */

const noScripts =
  "needs scripts, which never run here; the book itself says that the test is then not relevant";
const noScripting = "scripts never run";

/** Tests that do not apply, by the words of the test itself. */
export const notApplicable = {
  "fxl-layout-duplication": "is about EPUBCheck",
  "lay-pp-layout-duplication": "is about EPUBCheck",
  "lay-reflow-align-x-center": "is for systems that support rendition:align-x-center",
  "ocf-url_origin": noScripts,
  "ocf-url_parse-leaking-relative": noScripts,
  "ocf-url_parse-path-absolute": noScripts,
  "pkg-linked-records": "is for systems that support linked records",
  "scr-support_origin": noScripts,
  "scr-support_origin_unique": noScripts,
  "scr-support_scrolled-continuous": noScripts,
  "scr-support_scrolled-doc": noScripts,
};

const named = (reason, ...tests) => Object.fromEntries(tests.map((test) => [test, reason]));

/** Tests of what Turnleaf does not do. */
export const missing = {
  ...named(
    noScripting,
    "scr-readingsystem-features",
    "scr-readingsystem-support",
    "scr-readingsystem-support_iframe",
    "scr-readingsystem-support_iframe_svg",
    "scr-readingsystem-support_svg",
    "scr-support",
    "scr-support_iframe",
    "scr-support_svg",
  ),
  "lay-fxl-orientation-landscape":
    "a page is shown as wide as it is, without a word about the device",
  "lay-fxl-xhtml-icb_device_sizes": "a page has no size of the device",
};
