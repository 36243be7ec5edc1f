/** Which addresses are of the public internet, and which of this machine or of networks around it. */

import { type LookupAddress, lookup } from "node:dns";
import { BlockList, isIP, isIPv4, type LookupFunction } from "node:net";

/** Networks that are not of the public internet, by IANA's registries of special-purpose addresses. */
const inner = new BlockList();
for (const [network, bits] of [
  ["0.0.0.0", 8],
  ["10.0.0.0", 8],
  ["100.64.0.0", 10],
  ["127.0.0.0", 8],
  ["169.254.0.0", 16],
  ["172.16.0.0", 12],
  ["192.0.0.0", 24],
  ["192.168.0.0", 16],
  ["198.18.0.0", 15],
  ["224.0.0.0", 3],
] as const) {
  inner.addSubnet(network, bits, "ipv4");
  // The same through IPv6: mapped, translated (NAT64) and tunnelled (6to4).
  const groups = hexGroups(network);
  inner.addSubnet(`::ffff:${groups}`, 96 + bits, "ipv6");
  inner.addSubnet(`64:ff9b::${groups}`, 96 + bits, "ipv6");
  inner.addSubnet(`2002:${groups}::`, 16 + bits, "ipv6");
}
for (const [network, bits] of [
  ["::", 96],
  ["64:ff9b:1::", 48],
  ["fc00::", 7],
  ["fe80::", 9],
  ["ff00::", 8],
] as const) {
  inner.addSubnet(network, bits, "ipv6");
}

/** Returns an IPv4 address as two groups of an IPv6 address. */
function hexGroups(address: string): string {
  const [a = 0, b = 0, c = 0, d = 0] = address.split(".").map(Number);
  return `${(256 * a + b).toString(16)}:${(256 * c + d).toString(16)}`;
}

/** Returns whether an IP address is of this machine or of a network around it. */
export function isInnerAddress(address: string): boolean {
  return inner.check(address, isIPv4(address) ? "ipv4" : "ipv6");
}

/** Where a host is: looked up once, so that what was checked is what is connected to. */
export interface Place {
  /** Whether it is on this machine or on a network around it, with one of its addresses at least. */
  readonly isInner: boolean;
  /** Finds this place, for `http.request`. */
  readonly lookup: LookupFunction;
}

/** Returns where a host is. Rejects if it has no address. */
export async function placeOf(hostname: string): Promise<Place> {
  const host = hostname.replace(/^\[|\]$/g, "");
  const family = isIP(host);
  const found: readonly LookupAddress[] =
    family === 0 ? await addressesOf(host) : [{ address: host, family }];
  return {
    isInner: found.some(({ address }) => isInnerAddress(address)),
    lookup: (_, { all }, callback) => {
      const [first] = found;
      if (all) callback(null, [...found]);
      else if (first) callback(null, first.address, first.family);
    },
  };
}

/** Returns whether an address of the web is of this machine or of a network around it; one that is nowhere is not. */
export async function isInnerPlace(address: string): Promise<boolean> {
  const place = await placeOf(new URL(address).hostname).catch(() => null);
  return place?.isInner ?? false;
}

function addressesOf(host: string): Promise<readonly LookupAddress[]> {
  return new Promise((resolve, reject) => {
    lookup(host, { all: true }, (error, found) => (error ? reject(error) : resolve(found)));
  });
}
