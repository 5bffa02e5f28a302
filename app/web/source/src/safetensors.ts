// Reads a safetensors file: eight bytes of length, a JSON header, then the numbers.

type Numbers = Float64Array | Float32Array | Int32Array | Uint32Array | Uint16Array | Uint8Array;

const TYPES = {
  F64: Float64Array,
  F32: Float32Array,
  I32: Int32Array,
  U32: Uint32Array,
  U16: Uint16Array,
  U8: Uint8Array,
} as const;

export interface Tensors {
  metadata: Record<string, string>;
  get(name: string): Numbers;
}

export function readTensors(buffer: ArrayBuffer): Tensors {
  const view = new DataView(buffer);
  const size = Number(view.getBigUint64(0, true));
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, size)));
  return {
    metadata: header.__metadata__ ?? {},
    get(name) {
      const { dtype, data_offsets: [start, end] } = header[name];
      // A copy, because numbers need not lie where their type may start.
      return new TYPES[dtype as keyof typeof TYPES](buffer.slice(8 + size + start, 8 + size + end));
    },
  };
}
