/** Packages of the Open eBook Publication Structure, which EPUB's come from, and others that write names as it did. */

const opf = "http://www.idpf.org/2007/opf";

/** The namespace of titles and names in a package, and what it began with in every version. */
export const dublinCore = "http://purl.org/dc/elements/1.1/";
const anyDublinCore = /^http:\/\/purl\.org\/(?:dc\/elements\/|metadata\/dublin_core)/;

/** Elements within the metadata around parts of them. */
const wrapping = /^(dc|x)-metadata$/;

/** Gives the elements of a package the names and the namespaces that EPUB has for them. Returns its root. */
export function modernPackage(document: Document): Element {
  let root = document.documentElement;
  const { namespaceURI: own } = root;
  for (const element of [...document.getElementsByTagName("*")]) {
    const { namespaceURI: namespace, localName } = element;
    if (anyDublinCore.test(namespace ?? "")) {
      renamed(element, dublinCore, localName.toLowerCase());
    } else if (namespace === own && wrapping.test(localName)) {
      element.replaceWith(...element.childNodes);
    } else if (namespace === own) {
      const named = renamed(element, opf, localName);
      if (element === root) root = named as HTMLElement;
    }
  }
  return root;
}

/** Replaces an element by one of another name with the same attributes and content, which it returns. */
function renamed(element: Element, namespace: string, name: string): Element {
  if (element.namespaceURI === namespace && element.localName === name) return element;
  const other = element.ownerDocument.createElementNS(namespace, name);
  for (const attribute of [...element.attributes]) {
    if (attribute.localName !== "xmlns" && attribute.prefix !== "xmlns") {
      other.setAttributeNodeNS(element.removeAttributeNode(attribute));
    }
  }
  other.append(...element.childNodes);
  element.replaceWith(other);
  return other;
}
