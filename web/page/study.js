// A worker: studies of whole scenarios, away from the thread that draws.
import {Core, Refused} from './core.js';

let core;

self.onmessage = ({data}) => {
  if (data.module) {
    core = new Core(data.module);
    return;
  }
  const {values, study, scalars} = data;
  try {
    core.resolve(values);
    self.postMessage({result: core.study(study, scalars)});
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    self.postMessage({refused: error.message});
  }
};
