// What was seen is kept, within bounds, for a page that plays it without the program.

const mostRecorded = 32e6;  // [byte]
const record = { fixed: [], frames: [], bytes: 0, folded: [] };

/** Keeps the bytes of a message. */
function keep(kind, buffer) {
  if (kind === "hello") Object.assign(record, { fixed: [], frames: [], bytes: 0, folded: [] });
  if (["hello", "solids", "posts"].includes(kind)) {
    record.fixed.push(buffer);
    record.bytes += buffer.byteLength;
  } else if (["frame", "stage", "trails", "history", "matrix"].includes(kind)) {
    record.frames.push({ at: performance.now(), buffer });
    record.bytes += buffer.byteLength;
  }
  while (record.bytes > mostRecorded && record.frames.length > 1) fold(record.frames.shift());
}

/** A frame that is dropped leaves its landmarks behind. */
function fold({ buffer }) {
  record.bytes -= buffer.byteLength;
  const message = decode(buffer);
  if (message.kind !== "frame") return;
  message.estimators.forEach((_, i) => {
    const map = record.folded[i] = record.folded[i] || new Map();
    message.arrays[`ids${i}`].forEach((id, k) => map.set(id, message.arrays[`means${i}`].slice(2 * k, 2 * k + 2)));
  });
}

/** The first frame of what is kept, with the landmarks of all that was dropped. */
function startFrame() {
  const first = record.frames.map(({ buffer }) => decode(buffer)).find(({ kind }) => kind === "frame");
  if (!first || record.folded.length === 0) return [];
  const arrays = { ...first.arrays };
  record.folded.forEach((map, i) => {
    arrays[`ids${i}`] = Uint32Array.from(map.keys());
    arrays[`means${i}`] = Float32Array.from([...map.values()].flatMap((mean) => [...mean]));
  });
  return [{ at: record.frames[0].at, buffer: encode(first, arrays) }];
}

function base64Of(bytes) {
  const parts = [];
  for (let at = 0; at < bytes.length; at += 30000) parts.push(btoa(String.fromCharCode(...bytes.subarray(at, at + 30000))));
  return parts.join("");
}

/** Each message: its time [ms] (32 bits), its length (32 bits), and its bytes. */
function packed() {
  const begin = record.frames.length > 0 ? record.frames[0].at : 0;
  const all = [...record.fixed.map((buffer) => ({ at: begin, buffer })), ...startFrame(), ...record.frames];
  const bytes = new Uint8Array(all.reduce((sum, { buffer }) => sum + 8 + buffer.byteLength, 0));
  const numbers = new DataView(bytes.buffer);
  let at = 0;
  for (const { at: time, buffer } of all) {
    numbers.setUint32(at, Math.round(time - begin), true);
    numbers.setUint32(at + 4, buffer.byteLength, true);
    bytes.set(new Uint8Array(buffer), at + 8);
    at += 8 + buffer.byteLength;
  }
  return bytes;
}

function download(name, href) {
  const link = element("a", "", { href, download: name });
  document.body.append(link);
  link.click();
  link.remove();
}

const fileName = (ending) => `${state.hello.name}-${state.t.toFixed(1)}s.${ending}`.replace(/[^A-Za-z0-9._-]/g, "_");

byId("save-still").onclick = () => {
  render();
  download(fileName("png"), byId("scene").toDataURL("image/png"));
};
/** This very page, with what was seen in it. */
async function pageOfWhatWasSeen() {
  const source = await (await fetch(location.href)).text();
  const first = source.indexOf("<script>");  // the page's own scripts look for it
  return `${source.slice(0, first)}<script type="text/plain" id="recorded">${base64Of(packed())}</` + `script>\n${source.slice(first)}`;
}
byId("save-page").onclick = async () => {
  const url = URL.createObjectURL(new Blob([await pageOfWhatWasSeen()], { type: "text/html" }));
  download(fileName("html"), url);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
};
for (const button of document.querySelectorAll("[data-save]"))
  button.onclick = () => {
    byId("saved").textContent = "saving …";
    wire.send({ do: "save", what: button.dataset.save });
  };
on("saved", (message) => {
  byId("saved").textContent = message.text;
  toast(message.text, false);
});

// Playing.

const player = {
  messages: [], next: 0, isPlaying: false, clock: 0,

  load(text) {
    const bytes = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
    const numbers = new DataView(bytes.buffer);
    for (let at = 0; at < bytes.length;) {
      const length = numbers.getUint32(at + 4, true);
      this.messages.push({ at: numbers.getUint32(at, true), buffer: bytes.buffer.slice(at + 8, at + 8 + length) });
      at += 8 + length;
    }
    byId("time").min = "0";
    byId("time").max = String(this.messages[this.messages.length - 1].at / 1000);
  },
  toggle() {
    if (this.next >= this.messages.length) this.seek(0);
    this.isPlaying = !this.isPlaying;
    showState();
  },
  /** Shows the moment `seconds` after the beginning. */
  seek(seconds) {
    this.clock = 1000 * seconds;
    this.next = 0;
    this.playUpTo(this.clock);
  },
  playUpTo(clock) {
    while (this.next < this.messages.length && this.messages[this.next].at <= clock) take(this.messages[this.next++].buffer);
    byId("time").max = String(this.messages[this.messages.length - 1].at / 1000);
    byId("time").value = String(clock / 1000);
    byId("time-text").textContent = `${(clock / 1000).toFixed(1)} s`;
    if (this.next >= this.messages.length) this.isPlaying = false;
    showState();
  },
  tick(ms) {
    if (!this.isPlaying) return;
    this.clock += ms;
    this.playUpTo(this.clock);
  },
};
