/**
 * Has pdf.js find all pages of a file whose tree of pages is damaged. As it comes, it believes the tree's /Count,
 * so a book of more pages loses some, one of 0 all of them; and it ends at the first branch that is damaged, so
 * the pages behind that are lost too, without a word.
 */

/** The worker that reads documents, whose code is changed. */
export const readingWorker = "pdfjs-dist/legacy/build/pdf.worker.min.mjs";

const circular = 'addPageError(new FormatError("Pages tree contains circular reference."));';
const wrongType =
  'addPageError(new FormatError("Page dictionary kid reference points to wrong type of object."));';
const noArray = 'addPageError(new FormatError("Page dictionary kids object is not an array."));';

/** What is in the code, and what stands there instead. */
const changes = [
  // Without a trailer that names it, the catalog is the object that says that it is one.
  ["if(!m.length)for(const e in this.#zn){", "for(const e in this.#zn){"],
  [
    'if(a instanceof Dict&&a.has("Root"))return a}throw',
    'if(!(a instanceof Dict))continue;if(a.has("Root"))return a;if(isName(a.getRaw("Type"),"Catalog")&&a.has("Pages")){const e=new Dict(this);e.set("Root",n);return e}}throw',
  ],
  // A count of the whole tree that is wrong is found by a page behind it; then pdf.js walks all of the tree.
  [
    "if(a<=1)return;await this.getPage(a-1)}",
    'if(a<1)throw new FormatError("Page count is not positive.");await this.getPage(a-1);if(await t.getPageDict(a).then(()=>!0,()=>!1))throw new FormatError("There are more pages than their count.")}',
  ],
  [
    "if(Number.isInteger(c)&&c>=0){f&&",
    "if(a!==this.toplevelPagesDict&&Number.isInteger(c)&&c>=0){f&&",
  ],
  // What is no page stands for one: those behind it are found.
  [
    'if(!(a instanceof Dict))throw new FormatError("Page dictionary kid reference points to wrong type of object.");',
    'if(!(a instanceof Dict)){if(l++<e)continue;throw new FormatError("Page dictionary kid reference points to wrong type of object.")}',
  ],
  // The walk goes on behind what is damaged, which is a page that says so.
  [
    "s=await i.fetchAsync(s)}catch(e){addPageError(e);break}",
    "s=await i.fetchAsync(s)}catch(e){addPageError(e);n.pop();continue}",
  ],
  [`${noArray}break}`, `${noArray}n.pop();continue}`],
  [
    'if(isName(e,"Page")||!t.has("Kids")){addPageDict(t,null);break}',
    'if(isName(e,"Pages")&&!t.has("Kids")){n.pop();continue}if(isName(e,"Page")||!t.has("Kids")){addPageDict(t,null);break}',
  ],
  // A page that is listed twice is there twice.
  [
    `if(a.has(o)){${circular}break}`,
    `if(a.has(o)&&!this.pageIndexCache.has(o)){${circular}e.posInKids++;continue}`,
  ],
  [`${wrongType}break}`, `${wrongType}e.posInKids++;continue}`],
  [
    "f=await i.fetchAsync(f)}catch(e){addPageError(e);break}",
    "f=await i.fetchAsync(f)}catch(t){addPageError(t);e.posInKids++;continue}",
  ],
  // A first page that is damaged says so too, and is not blank; a tree with nothing else has no pages.
  ["if(e&&t&&0===l){", "if(!1){"],
  [
    "posInKids:0});e.posInKids++}return s}",
    "posInKids:0});e.posInKids++}if([...s.values()].every(([e])=>e instanceof Error))s.clear();return s}",
  ],
];

/** The Apache licence asks files that were changed to say so. */
const notice = "/*! Changed for Turnleaf: it finds the pages of damaged trees. */\n";

/** Returns the code of the worker that finds all pages. Throws if it is of another version than these changes. */
export function withWholePageTree(code) {
  return changes.reduce((changed, [from, to]) => {
    const parts = changed.split(from);
    if (parts.length === 2) return parts.join(to);
    throw new Error(`pdf.js has ${parts.length - 1} times: ${from}`);
  }, notice + code);
}

/** Changes the worker where its module is imported. */
export function wholePageTree() {
  return {
    name: "turnleaf-whole-page-tree",
    transform(code, id) {
      return id.endsWith(readingWorker) ? { code: withWholePageTree(code), map: null } : null;
    },
  };
}
