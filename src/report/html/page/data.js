// Reads the arrays of the page: the way back of src/report/html/array_encoding.rs.

const facts = JSON.parse(document.getElementById("facts").textContent);

function fromBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Bytes of one significance stand together.
function fromPlanes(bytes, size) {
  const count = bytes.length / size;
  if (size === 4) {
    // Four planes at once: a page has tens of millions of these numbers. Browsers run on little-endian machines only.
    const numbers = new Uint32Array(count), [b, c, d] = [count, 2 * count, 3 * count];
    for (let i = 0; i < count; i++) numbers[i] = bytes[i] | (bytes[b + i] << 8) | (bytes[c + i] << 16) | (bytes[d + i] << 24);
    return numbers.buffer;
  }
  const sorted = new Uint8Array(bytes.length);
  for (let plane = 0; plane < size; plane++) {
    const start = plane * count;
    for (let i = 0, at = plane; i < count; i++, at += size) sorted[at] = bytes[start + i];
  }
  return sorted.buffer;
}

const KINDS = {
  f32: (bytes) => new Float32Array(fromPlanes(bytes, 4)),
  growing: (bytes) => {
    const values = new Uint32Array(fromPlanes(bytes, 4));
    for (let i = 1; i < values.length; i++) values[i] += values[i - 1];
    return values;
  },
  u16: (bytes) => new Uint16Array(fromPlanes(bytes, 2)),
  u8: (bytes) => bytes,
};

// An array of the page. Its element leaves the page: the text would take memory twice.
async function readArray(element) {
  const bytes = fromBase64(element.content.textContent);
  element.remove();
  return KINDS[element.dataset.kind](await inflate(bytes));
}

// All arrays by name, but the text of the listing.
async function readArrays() {
  const found = {}, elements = [...document.querySelectorAll("template[data-array]:not([data-array=text])")];
  await Promise.all(elements.map(async (element) => { found[element.dataset.array] = await readArray(element); }));
  // Of some there are the bits in which they differ from another array.
  for (const { dataset: { array, over } } of elements) {
    if (!over) continue;
    const bits = new Uint32Array(found[array].buffer), base = new Uint32Array(found[over].buffer);
    for (let i = 0; i < bits.length; i++) bits[i] ^= base[i];
  }
  return found;
}

// The text of the listing, which is as long as all numbers: it is read once all else is shown.
const readText = () => readArray(document.querySelector("template[data-array=text]"));
