/**
 * Changes pdf.js's worker, for what cannot be mended from outside. As it comes:
 *
 * - It believes the /Count of the tree of pages, so a book of more pages loses some, one of 0 all of them; and
 *   it ends at the first branch that is damaged, so the pages behind that are lost too, without a word.
 * - It drops a link or a line of the contents that names its page and not, or not rightly, which part of it.
 * - It says of no text that it lies on a layer that is off, or which words a file names for what is drawn.
 * - It draws text upon a page that has no appearance as one line, however small, and none that has styles; and
 *   frames without an appearance only where their width is given.
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
    'if(a<1)throw new FormatError("Page count is not positive.");await this.getPage(a-1);if(!await hasTrueCounts(t.toplevelPagesDict,t.xref)||await t.getPageDict(a).then(()=>!0,()=>!1))throw new FormatError("There are other pages than their count.")}',
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
  // What is marked in a page's text says on which layer it lies, and for which words it stands.
  [
    'w.items.push({type:"beginMarkedContentProps",',
    'w.items.push({...markOf(isName(y[0],"OC"),y[1],n,v),type:"beginMarkedContentProps",',
  ],
  // A form on a layer is marked as text on it is.
  [
    "enqueueChunk();const C=textSinkWrapper(s);",
    'enqueueChunk();const isMarked=r&&m.has("OC"),mark=e=>isMarked&&s.enqueue({items:[e],styles:{}},1);mark({...markOf(!0,m.get("OC"),n,v),type:"beginMarkedContentProps"});const C=textSinkWrapper(s);',
  ],
  [
    ".then(function(){C.enqueueInvoked||",
    '.then(function(){mark({type:"endMarkedContent"});C.enqueueInvoked||',
  ],
  // Text upon a page is broken at the box's width, and is there if it has styles alone.
  [
    "o=[];let l=-1/0;for(const t of e.split(/\\r\\n?|\\n/)){",
    "o=[];let lines;[lines,a]=fitText(e,i,a,t[2]-t[0],t[3]-t[1],n%180!=0);let l=-1/0;for(const t of lines){",
  ],
  [
    "class FreeTextAnnotation extends MarkupAnnotation{constructor(e){super(e);",
    "class FreeTextAnnotation extends MarkupAnnotation{constructor(e){super(e);this._contents.str||=this.data.richText?.str??'';",
  ],
  // A frame whose width is not given is as wide as any line.
  [
    "else{this.borderStyle.setWidth(0);",
    'else{/^(Square|Circle)$/.test(e.get("Subtype")?.name)||this.borderStyle.setWidth(0);',
  ],
  // A destination is a page; what of it is to be seen is not asked for.
  [
    "if(!Array.isArray(n)||n.length<2)return!1;const[a,r,...s]=n;",
    "if(!Array.isArray(n))return!1;const[a,r,...s]=n;",
  ],
  [
    "if(!e(a)&&!Number.isInteger(a))return!1;if(!t(r))return!1;",
    "return e(a)||Number.isInteger(a);",
  ],
];

/**
 * Returns whether the branches of a tree of pages have as many pages as they say. A count that is wrong by as
 * much as another hides pages, or shows them twice, without changing that of the whole tree. Runs in the
 * worker.
 *
 * In a file that arrives in pieces, a branch with as many kids as pages is believed to have no other branches:
 * otherwise each of its pages would be requested. Its root's kids are, by pdf.js itself.
 *
 * @param root the root's dictionary
 * @param xref what finds objects of the file
 */
async function hasTrueCounts(root, xref) {
  const branches = new Set([root]);
  // Those that are added are visited too.
  for (const branch of branches) {
    const kids = await branch.getAsync("Kids");
    const count = await branch.getAsync("Count");
    if (!Array.isArray(kids)) return false;
    if (branch !== root && count === kids.length && !xref.stream.isDataLoaded) continue;
    let pages = 0;
    for (const kid of await Promise.all(kids.map((one) => xref.fetchIfRefAsync(one)))) {
      const isBranch = kid instanceof Dict && kid.has("Kids") && kid.get("Type")?.name !== "Page";
      if (isBranch && branches.has(kid)) return false;
      if (isBranch) branches.add(kid);
      pages += isBranch ? await kid.getAsync("Count") : 1;
    }
    if (pages !== count) return false;
  }
  return true;
}

/**
 * Returns what a mark in a page's content says of it: the layer on which it lies, as pdf.js describes one to
 * itself, or the words for which it stands. Runs in the worker.
 *
 * @param properties the mark's, or the name that they have in `resources`
 */
function markOf(isLayer, properties, resources, xref) {
  try {
    if (isLayer) return { layer: parseMarkedContentProps(xref, properties, resources) };
    const isNamed = properties instanceof Name;
    const words = isNamed ? resources.get("Properties").get(properties.name) : properties;
    const actualText = words.get("ActualText");
    return typeof actualText === "string" ? { actualText: stringToPDFString(actualText) } : {};
  } catch (error) {
    if (error instanceof MissingDataException) throw error;
    return {};
  }
}

/**
 * Returns the lines of a text, broken between words, and the size of its letters with which it fits into a
 * box: the given one, or a smaller one. Runs in the worker.
 *
 * @param context in which text is measured, in letters 1,000 high
 */
function fitText(text, context, size, width, height, isUpright) {
  const [across, down] = isUpright ? [height, width] : [width, height];
  const paragraphs = text.split(/\r\n?|\n/);
  for (let smaller = size; ; smaller *= 0.9) {
    const lines = [];
    for (const paragraph of paragraphs) {
      const [first, ...words] = paragraph.split(" ");
      lines.push(first);
      for (const word of words) {
        const longer = `${lines.at(-1)} ${word}`;
        const isWithin = (context.measureText(longer).width * smaller) / 1000 <= across;
        if (isWithin) lines[lines.length - 1] = longer;
        else lines.push(word);
      }
    }
    // Lines of pdf.js are 1.35 times as high as letters. Smaller letters than a third are not read.
    if (lines.length * 1.35 * smaller <= down || smaller < size / 3) return [lines, smaller];
  }
}

/** The Apache licence asks files that were changed to say so. */
const notice = "/*! Changed for Turnleaf: it reads more of damaged files. */\n";

/** Returns the code of the worker with these changes. Throws if it is of another version than these changes. */
export function withChanges(code) {
  return changes.reduce(
    (changed, [from, to]) => {
      const parts = changed.split(from);
      if (parts.length === 2) return parts.join(to);
      throw new Error(`pdf.js has ${parts.length - 1} times: ${from}`);
    },
    `${notice}${code}
${hasTrueCounts}\n${markOf}\n${fitText}`,
  );
}

/** Changes the worker where its module is imported. */
export function changedPdfWorker() {
  return {
    name: "turnleaf-changed-pdf-worker",
    transform(code, id) {
      return id.endsWith(readingWorker) ? { code: withChanges(code), map: null } : null;
    },
  };
}
