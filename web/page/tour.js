// A tour of five steps, for example for a lecture: each sets a scenario, presses a button and explains what to look at.

export const steps = [
  {
    title: 'A weight between two ribbons',
    words: 'Two steel ribbons, covered with tape, are clipped together at their ends. Without voltage a load of 8 g bows them apart by 21 mm. Move the slider of the load: the stroke follows.',
    values: {'liquid.model': 'none'},
    button: 'release',
  },
  {
    title: 'It zips from its ends',
    words: 'Step applies 10 kV to the ribbons. The field is strongest where they are close, at the clips, so the zip front runs from there to the middle and lifts the load. The colours show the field.',
    values: {'liquid.model': 'none'},
    button: 'step',
  },
  {
    title: 'It closes at one voltage and opens at another',
    words: 'In “Stroke over voltage” solid lines are stable equilibria, dashed lines unstable ones. As the voltage rises slowly, the actuator closes where the solid line ends, near 6 kV; as it falls, the actuator opens below 1 kV. Press Hold: a low voltage keeps it closed.',
    values: {'liquid.model': 'none'},
    button: 'step',
  },
  {
    title: 'A design chart',
    words: 'In “Largest load over voltage” the dot is the present scenario: below the curve it closes. Drag the steel thickness and watch the curve. Thick ribbons lift more, but less far.',
    values: {'liquid.model': 'none', 'ribbon.thickness': '100 um', 'load.mass': '20 g'},
    button: 'step',
  },
  {
    title: 'The liquid takes time',
    words: 'In a bath the oil must leave the gap before the faces meet: look at the film and the pressure along the ribbon. Lower the viscosity with its slider, then choose another liquid or supply.',
    values: {'liquid.model': 'submerged'},
    button: 'step',
  },
];

export class Tour {
  #button;
  #guide;
  #show;
  #at = 0;

  /** `show` gets the values of a step and the button to press. */
  constructor(button, guide, show) {
    this.#button = button;
    this.#guide = guide;
    this.#show = show;
    const [back, next, end] = guide.querySelectorAll('button');
    button.addEventListener('click', () => (guide.hidden ? this.#go(0) : this.#end()));
    back.addEventListener('click', () => this.#go(this.#at - 1));
    next.addEventListener('click', () => (this.#at + 1 < steps.length ? this.#go(this.#at + 1) : this.#end()));
    end.addEventListener('click', () => this.#end());
    guide.addEventListener('keydown', ({key}) => key === 'Escape' && this.#end());
  }

  #go(at) {
    const {title, words, values, button} = steps[at], heading = this.#guide.querySelector('h2');
    this.#at = at;
    heading.textContent = `${at + 1} of ${steps.length}: ${title}`;
    this.#guide.querySelector('p').textContent = words;
    const [back, next] = this.#guide.querySelectorAll('button');
    back.disabled = at === 0;
    next.textContent = at + 1 < steps.length ? 'Next' : 'Finish';
    this.#opened(true);
    heading.focus();
    this.#show(values, button);
  }

  #end() {
    this.#opened(false);
    this.#button.focus();
  }

  #opened(open) {
    this.#guide.hidden = !open;
    this.#button.setAttribute('aria-expanded', String(open));
  }
}
