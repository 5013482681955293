// The connection to the program: messages as docs/live.md describes them.

const kinds = { f32: Float32Array, u32: Uint32Array, u8: Uint8Array };

/** A message from its bytes: the JSON, with each array under its name in `arrays`. */
function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const message = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const arrays = {};
  let at = 4 + length;
  for (const [name, type, count] of message.arrays) {
    arrays[name] = new kinds[type](buffer, at, count);
    at += Math.ceil(count * kinds[type].BYTES_PER_ELEMENT / 4) * 4;
  }
  message.arrays = arrays;
  return message;
}

/** The bytes of a message, for a page that plays what was seen. */
function encode(json, arrays) {
  const list = Object.entries(arrays).map(([name, values]) =>
    [name, values instanceof Float32Array ? "f32" : values instanceof Uint32Array ? "u32" : "u8", values.length]);
  const text = new TextEncoder().encode(JSON.stringify({ ...json, arrays: list }));
  const length = Math.ceil(text.length / 4) * 4;
  const sizes = Object.values(arrays).map((values) => Math.ceil(values.byteLength / 4) * 4);
  const bytes = new Uint8Array(4 + length + sizes.reduce((sum, size) => sum + size, 0)).fill(32);
  new DataView(bytes.buffer).setUint32(0, length, true);
  bytes.set(text, 4);
  let at = 4 + length;
  Object.values(arrays).forEach((values, i) => {
    bytes.set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength), at);
    at += sizes[i];
  });
  return bytes.buffer;
}

const wire = {
  socket: null,
  seq: 0,
  receive: () => {},
  changed: () => {},

  isOpen() { return this.socket !== null && this.socket.readyState === WebSocket.OPEN; },

  /** Sends a request, and returns its number; 0 if there is no connection. */
  send(request) {
    if (!this.isOpen()) return 0;
    this.socket.send(JSON.stringify({ ...request, seq: ++this.seq }));
    return this.seq;
  },

  connect() {
    const token = new URLSearchParams(location.search).get("token") || "";
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.socket = new WebSocket(`${scheme}://${location.host}/socket?token=${encodeURIComponent(token)}`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = (event) => this.receive(event.data);
    this.socket.onopen = () => this.changed();
    this.socket.onclose = () => {
      this.changed();
      setTimeout(() => this.connect(), 2000);
    };
  },
};
