/** The Khronos validator, as far as the tests use it. */
declare module "gltf-validator" {
  export function validateBytes(bytes: Uint8Array): Promise<{
    readonly info: { readonly animationCount: number };
    readonly issues: {
      readonly numErrors: number;
      readonly numWarnings: number;
      readonly messages: readonly { readonly code: string }[];
    };
  }>;
}
