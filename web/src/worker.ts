// The worker of the page: emscripten's script stands before this one, as one classical script.
import type { Factory } from "./core";
import { serve, type ToWorker } from "./serve";

declare const holdfastModule: Factory;

const post = self.postMessage.bind(self) as (message: unknown, moved?: Transferable[]) => void;
const take = serve(holdfastModule, (message, moved) => post(message, moved));
self.onmessage = (event: MessageEvent<ToWorker>) => void take(event.data);
