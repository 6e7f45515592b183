// The Worker of `startWorker`: a module Worker in browsers, a thread in Node.
import factory from "holdfast-module";
import type { Factory } from "./core";
import { serve, type ToWorker } from "./serve";

if (typeof process !== "undefined" && process.versions?.node !== undefined) {
  const { parentPort } = await import("node:worker_threads");
  const take = serve(factory as Factory, (message, moved) => parentPort!.postMessage(message, moved));
  parentPort!.on("message", (message: ToWorker) => void take(message));
} else {
  const post = self.postMessage.bind(self) as (message: unknown, moved?: Transferable[]) => void;
  const take = serve(factory as Factory, (message, moved) => post(message, moved));
  self.onmessage = (event: MessageEvent<ToWorker>) => void take(event.data);
}
