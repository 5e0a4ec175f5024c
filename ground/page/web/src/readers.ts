// How a message of the wire becomes a value of its type, whatever the wire says.
//
// A message is described once, by a table of readers, and its type follows from the table. A field that is absent or of
// another kind reads as nothing (0, "", false, []), as in Protobuf, so that no message can make the page fall over.
// JSON has no infinities and no 64-bit numbers: Protobuf writes both as strings.

export interface Reader<T> {
  readonly kind: string;
  readonly read: (wire: unknown) => T;
}

export type Of<R> = R extends Reader<infer T> ? T : never;

type Fields = Record<string, Reader<unknown>>;
type Shape<F extends Fields> = { -readonly [K in keyof F]: Of<F[K]> };

export interface MessageReader<T> extends Reader<T> {
  readonly fields: Fields;
}

function read_real(wire: unknown): number {
  if (typeof wire === 'number') return wire;
  if (wire === 'Infinity') return Infinity;
  if (wire === '-Infinity') return -Infinity;
  if (wire === 'NaN') return NaN;
  return 0;
}

function read_whole(wire: unknown): number {
  const value = typeof wire === 'string' ? Number(wire) : wire;
  return typeof value === 'number' && Number.isFinite(value) ? value : 0;
}

export const real: Reader<number> = { kind: 'double', read: read_real };
export const whole: Reader<number> = { kind: 'uint32', read: read_whole };
/** Counts on the wire as a string; beyond 2^53 the last digits are lost, which no count of ours reaches. */
export const long: Reader<number> = { kind: 'uint64', read: read_whole };
export const text: Reader<string> = { kind: 'string', read: (wire) => (typeof wire === 'string' ? wire : '') };
export const flag: Reader<boolean> = { kind: 'bool', read: (wire) => wire === true };

export function choice<const N extends string>(kind: string, names: readonly [N, ...N[]]): Reader<N> {
  return { kind, read: (wire) => names.find((name) => name === wire) ?? names[0] };
}

export function list<T>(of: Reader<T>): Reader<T[]> {
  return { kind: `repeated ${of.kind}`, read: (wire) => (Array.isArray(wire) ? wire.map(of.read) : []) };
}

export function optional<T>(of: Reader<T>): Reader<T | undefined> {
  return { kind: `optional ${of.kind}`, read: (wire) => (wire === undefined || wire === null ? undefined : of.read(wire)) };
}

export function message<F extends Fields>(kind: string, fields: F): MessageReader<Shape<F>> {
  const entries = Object.entries(fields);
  const read = (wire: unknown): Shape<F> => {
    const from = typeof wire === 'object' && wire !== null ? (wire as Record<string, unknown>) : {};
    const out: Record<string, unknown> = {};
    for (const [name, reader] of entries) out[name] = reader.read(from[name]);
    return out as Shape<F>;
  };
  return { kind, fields, read };
}
