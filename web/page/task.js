// One piece of work at a time, in a worker of its own: to cancel it the worker is ended, and no other work is lost.

async function inflatedTemplate(id) {
  const text = document.getElementById(id).content.textContent;
  const letters = Uint8Array.fromBase64 ? Uint8Array.fromBase64(text) : Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Blob([letters]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
}

const textOf = async (id) => new Response(await inflatedTemplate(id)).text();

// The module is compiled once, the address of the worker's script is made once.
const library = (async () => {
  const bytes = await new Response(await inflatedTemplate("module")).arrayBuffer();
  const script = new Blob([await textOf("worker")], { type: "text/javascript" });
  return { module: await WebAssembly.compile(bytes), address: URL.createObjectURL(script) };
})();

class Task {
  // `told` gets { phase } and { fraction }. `done` resolves to a page, rejects with what went wrong, or never ends once it is cancelled.
  constructor(job, told) {
    this.done = new Promise((resolve, reject) => {
      library.then(({ module, address }) => {
        if (this.ended) return;
        this.worker = new Worker(address);
        this.worker.onmessage = ({ data }) => {
          if (data.page) { this.end(); resolve(data.page); }
          else if (data.error) { this.end(); reject(data.error); }
          else told(data);
        };
        this.worker.onerror = (event) => { this.end(); reject({ message: event.message || "the worker did not start" }); };
        this.worker.postMessage({ module, ...job });
      }).catch((error) => reject({ message: error.message }));
    });
  }

  // Ends the work at once, and gives its memory back.
  end() {
    this.ended = true;
    this.worker?.terminate();
  }
}
