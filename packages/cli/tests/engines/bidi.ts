import { WebSocket } from "ws";

/** A session of WebDriver BiDi: https://w3c.github.io/webdriver-bidi/ */
export interface BidiSession {
  readonly capabilities: { readonly browserVersion: string };
  /** Sends a command. Rejects with the browser's message if it fails, or if the session ends. */
  send(method: string, params: object): Promise<Record<string, unknown>>;
  disconnect(): void;
}

interface Reply {
  readonly id: number;
  readonly result?: Record<string, unknown>;
  readonly error?: string;
  readonly message?: string;
}

/** Opens a session at a browser's address. */
export async function connectBidi(url: string): Promise<BidiSession> {
  const socket = new WebSocket(url);
  await new Promise((resolve, reject) => {
    socket.once("open", resolve);
    socket.once("error", reject);
  });
  const waiting = new Map<number, (reply: Reply) => void>();
  socket.on("message", (data) => {
    const reply = JSON.parse(String(data)) as Reply;
    waiting.get(reply.id)?.(reply);
    waiting.delete(reply.id);
  });
  socket.on("close", () => {
    for (const [id, reply] of waiting) reply({ id, error: "the browser has gone" });
    waiting.clear();
  });
  let count = 0;
  const send: BidiSession["send"] = (method, params) =>
    new Promise((resolve, reject) => {
      const id = ++count;
      waiting.set(id, ({ result, error, message }) => {
        if (result) resolve(result);
        else reject(new Error(`${method}: ${error} ${message ?? ""}`));
      });
      socket.send(JSON.stringify({ id, method, params }));
    });
  const { capabilities } = await send("session.new", { capabilities: {} });
  return {
    capabilities: capabilities as BidiSession["capabilities"],
    send,
    disconnect: () => socket.close(),
  };
}
