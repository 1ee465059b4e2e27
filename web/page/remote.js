// An engine in a worker, with one request at a time. If it does not answer in time, it is ended and replaced.
import {Engine, limits} from './engine.js';
import source from 'worker:worker.js';

const tick = 250; // ms between looks at the engine: time in which the machine sleeps does not count
const ticks = (ms) => Math.ceil(ms / tick);
const startLimit = 10e3; // ms until a worker must be there
const grace = 2; // an engine stops by itself after its own limit; after this many times that it is stopped

let place; // address of the worker's script

export class Remote {
  /** The reason why engines run on the thread of the page, null if they run in workers. It is the same for all engines. */
  static local = null;

  #module;
  #answered;
  #worker = null;
  #engine = null; // where there is no worker
  #ready = false;
  #question = null; // what is being answered
  #waited = 0; // ticks

  /** `answered` gets each answer of an Engine; {stopped: {seconds}, lost: true} if it had to be ended, {broken: words,
   * lost: true} if it failed. The state of the engine is then lost; the next request starts another engine. */
  constructor(module, answered) {
    this.#module = module;
    this.#answered = answered;
    this.#begin();
    setInterval(() => this.#look(), tick);
  }

  get busy() {
    return this.#question !== null;
  }

  /** Approximate time for which the engine has been busy with its request, ms. */
  get waited() {
    return this.busy && this.#ready ? this.#waited * tick : 0;
  }

  /** Send a request, if not busy. Arrays in `given` are transferred to the engine and are empty here afterwards. */
  ask(question, given = []) {
    this.#question = question;
    this.#waited = 0;
    if (this.#worker) this.#worker.postMessage(question, given.map((array) => array.buffer));
    else setTimeout(() => this.#answerHere(question));
  }

  /** Discard the answer. */
  drop() {
    if (!this.#worker) return;
    this.#question = null;
    this.#again();
  }

  #begin() {
    this.#ready = false;
    this.#waited = 0;
    if (Remote.local !== null) return;
    try {
      place ??= URL.createObjectURL(new Blob([source], {type: 'text/javascript'}));
      this.#listen(new Worker(place));
      this.#worker.postMessage({module: this.#module});
    } catch (error) {
      this.#stay(String(error));
    }
  }

  /** Accept messages of the current worker only: an ended one may still have sent some. */
  #listen(worker) {
    this.#worker = worker;
    worker.onmessage = ({data}) => worker === this.#worker && this.#hear(data);
    worker.onerror = ({message}) => {
      if (worker !== this.#worker) return;
      if (this.#ready) this.#lose({broken: message});
      else this.#stay(message);
    };
  }

  #again() {
    this.#worker?.terminate();
    this.#worker = this.#engine = null;
    this.#begin();
  }

  #hear(data) {
    if (data.ready) {
      this.#ready = true;
      this.#waited = 0;
    } else if (data.broken) {
      this.#lose({broken: data.broken});
    } else {
      this.#give(data);
    }
  }

  #give(answer) {
    this.#question = null;
    this.#answered(answer);
  }

  #lose(answer) {
    this.#again();
    this.#give({...answer, lost: true});
  }

  #look() {
    if (!this.#worker || (this.#ready && !this.#question)) return;
    this.#waited++;
    const limit = this.#question?.study ? limits.worker.study : limits.worker.start;
    if (!this.#ready && this.#waited > ticks(startLimit)) this.#stay('it does not start');
    else if (this.#ready && this.#waited > ticks(grace * limit)) this.#lose({stopped: {seconds: (grace * limit) / 1e3}});
  }

  /** No worker starts: answer on this thread. */
  #stay(why) {
    Remote.local ??= why || 'it does not start';
    this.#worker?.terminate();
    this.#worker = null;
    if (this.#question) this.ask(this.#question);
  }

  #answerHere(question) {
    if (question !== this.#question) return;
    try {
      this.#engine ??= new Engine(this.#module, limits.page);
      this.#give(this.#engine.answer(question));
    } catch (error) {
      this.#lose({broken: String(error)});
    }
  }
}
