/** hammerjs as a module, for html-flip-book, which imports it so. */
import "/packages/hammerjs/hammer.js";

export default window.Hammer;
