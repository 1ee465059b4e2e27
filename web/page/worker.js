// A worker: an engine on a separate thread.
import {Engine, limits} from './engine.js';

let engine;

function answer(question) {
  try {
    return engine.answer(question);
  } catch (error) {
    return {broken: String(error)};
  }
}

self.onmessage = ({data}) => {
  if (data.module) {
    engine = new Engine(data.module, limits.worker);
    self.postMessage({ready: true});
    return;
  }
  const answered = answer(data);
  self.postMessage(answered, answered.frame ? [answered.frame.buffer] : []);
};
