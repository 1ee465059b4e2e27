// As much of a WebSocket client (RFC 6455) as driving a browser on this machine takes: texts both ways.
import {randomBytes} from 'node:crypto';
import {request} from 'node:http';

/** A client's frame of a text, masked. */
function frame(text) {
  const body = Buffer.from(text), mask = randomBytes(4);
  const size = body.length < 126 ? 0 : body.length < 65536 ? 2 : 8, head = Buffer.alloc(2 + size);
  head[0] = 0x81;
  head[1] = 0x80 | (size === 0 ? body.length : size === 2 ? 126 : 127);
  if (size === 2) head.writeUInt16BE(body.length, 2);
  if (size === 8) head.writeBigUInt64BE(BigInt(body.length), 2);
  return Buffer.concat([head, mask, body.map((byte, k) => byte ^ mask[k % 4])]);
}

export class WebSocket {
  #socket;
  #bytes = Buffer.alloc(0);
  #parts = [];
  #heard;

  /** `heard` gets each text. */
  static open(host, port, path, heard) {
    return new Promise((resolve, reject) => {
      const headers = {Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': randomBytes(16).toString('base64')};
      const asked = request({host, port, path, headers});
      asked.once('error', reject);
      asked.once('response', ({statusCode}) => reject(new Error(`status ${statusCode}`)));
      asked.once('upgrade', (_, socket, first) => resolve(new WebSocket(socket, first, heard)));
      asked.end();
    });
  }

  constructor(socket, first, heard) {
    this.#socket = socket;
    this.#heard = heard;
    socket.on('data', (bytes) => this.#take(bytes));
    socket.on('error', () => {});
    this.#take(first);
  }

  send(text) {
    this.#socket.write(frame(text));
  }

  end() {
    this.#socket.destroy();
  }

  #take(bytes) {
    this.#bytes = Buffer.concat([this.#bytes, bytes]);
    for (let used = this.#frame(); used > 0; used = this.#frame()) this.#bytes = this.#bytes.subarray(used);
  }

  /** The first frame, if it is complete => its length. */
  #frame() {
    const b = this.#bytes;
    if (b.length < 2) return 0;
    const short = b[1] & 0x7f, head = short < 126 ? 2 : short === 126 ? 4 : 10;
    if (b.length < head) return 0;
    const length = short < 126 ? short : short === 126 ? b.readUInt16BE(2) : Number(b.readBigUInt64BE(2));
    if (b.length < head + length) return 0;
    if ((b[0] & 0x0f) <= 1) this.#text(b.subarray(head, head + length), b[0] >= 0x80);
    return head + length;
  }

  #text(part, last) {
    this.#parts.push(Buffer.from(part));
    if (!last) return;
    this.#heard(Buffer.concat(this.#parts).toString());
    this.#parts = [];
  }
}
