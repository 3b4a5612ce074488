// The worker: one piece of work with the library, then it is ended. What it tells goes to `Task`.

let defect = "";

// The library calls these.
function tellPhase(phase) { postMessage({ phase }); }
function tellFraction(fraction) { postMessage({ fraction }); }
function tellDefect(message) { defect = message; }

async function bytesOf(file) {
  try {
    return new Uint8Array(await file.arrayBuffer());
  } catch (error) {
    throw new Error(`${file.name} cannot be read: it is a folder, or it was changed or removed since it was chosen (${error.message})`);
  }
}

// `program`, `before` are files, `others` files that setup and recipe are among, which are named.
async function work({ module, program, before, others, setup, recipe }) {
  wasm_bindgen.initSync({ module });
  postMessage({ phase: "reading" });
  for (const file of others) wasm_bindgen.give_file(file.name, await bytesOf(file));
  const bytes = await bytesOf(program);
  if (recipe) return wasm_bindgen.apply_recipe(recipe, program.name, bytes, setup);
  if (before) return wasm_bindgen.compare_programs(before.name, await bytesOf(before), program.name, bytes, setup);
  return wasm_bindgen.open_program(program.name, bytes, setup);
}

onmessage = async ({ data }) => {
  try {
    const page = await work(data);
    const arrays = Object.values(page.arrays ?? {}).map((array) => array.buffer);
    postMessage({ page }, page.output ? [...arrays, page.output.buffer] : arrays);
  } catch (error) {
    // A module that stops tells no more than "unreachable": of memory that is not there, there is no word.
    const stopped = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
    postMessage({ error: { message: String(error.message ?? error), defect, stopped } });
  }
};
