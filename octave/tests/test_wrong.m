% What is wrong ends in an error with the library's message, never in a crash.
1;

function refused = refused(count, pattern, varargin)
  refused = count + 1;
  try
    zipact(varargin{:});
  catch problem
    good = strcmp(problem.identifier, 'zipact:input') && ~isempty(regexp(problem.message, pattern, 'once'));
    check(good, 'attempt %d (%s): %s: %s', refused, pattern, problem.identifier, problem.message);
    return
  end
  error('test:failed', 'attempt %d (%s): was taken', refused, pattern);
end

n = 0;

% commands
n = refused(n, 'a study, or run');
n = refused(n, 'the first argument: takes a text', 3);
n = refused(n, 'the first argument: takes a text', {});
n = refused(n, 'the first argument: takes a text', struct());
n = refused(n, 'the first argument: takes a text', ['ab'; 'cd']);
n = refused(n, 'the first argument: takes a text', @sin);
n = refused(n, 'neither a study nor one of run', 'fly');
n = refused(n, 'neither a study nor one of run', '');
n = refused(n, 'neither a study nor one of run', repmat('x', 1, 1e5));
n = refused(n, 'control character', "run\0");
n = refused(n, 'contact.model = sequential', 'open', 'study', 'stationary', 'contact.model', 'sequential');
n = refused(n, 'short circuit', 'open', 'study', 'stationary', 'insulator.thickness', 0);
n = refused(n, 'takes no further arguments', 'keys', 1);
n = refused(n, 'takes no further arguments', 'version', 1);

% controllers
sim = zipact('open', 'mesh.nodes', 21, 'liquid.model', 'none');
n = refused(n, 'control: takes 5 to 5', 'control', sim);
n = refused(n, 'takes a function handle', 'control', sim, 3, 'opening', 1e-3, 1e-2);
n = refused(n, 'unknown signal openin;', 'control', sim, @(t, y) 0, 'openin', 1e-3, 1e-2);
n = refused(n, 'period', 'control', sim, @(t, y) 0, 'opening', 0, 1e-2);
n = refused(n, 'returns one number', 'control', sim, @(t, y) 'a lot', 'opening', 1e-3, 1e-2);
n = refused(n, 'controller''s voltage at', 'control', sim, @(t, y) -1, 'opening', 1e-3, 1e-2);
n = refused(n, 'can only be read', 'control', sim, @(t, y) zipact('step', sim, 1e-3), 'opening', 1e-3, 1e-2);
n = refused(n, 'controller: of its own', 'control', sim, @(t, y) error('of its own'), 'opening', 1e-3, 1e-2);
zipact('close', sim);

% keys
n = refused(n, 'unknown key; did you mean load.mass\?', 'stationary', 'load.mas', 1);
n = refused(n, 'unknown key', 'stationary', '', 1);
n = refused(n, 'unknown key', 'stationary', 'load', 1);
n = refused(n, 'unknown key', 'stationary', 'load.mass=1 #', 1);
n = refused(n, 'unknown key', 'stationary', repmat('k', 1, 1e5), 1);
n = refused(n, 'unknown key', 'stationary', char([255 254]), 1);
n = refused(n, 'control character', 'stationary', "load.mass\0", 1);
n = refused(n, 'key: takes a text', 'stationary', 3, 1);
n = refused(n, 'key: takes a text', 'stationary', {'load.mass'}, 1);
n = refused(n, 'load.mass: no value; keys and values come in pairs', 'stationary', 'load.mass');
n = refused(n, 'none.yaml: cannot be opened', 'stationary', 'none.yaml', 'load.mass', 1);

% values: units, ranges, types, shapes
n = refused(n, '^(zipact_mex: )?load\.mass=.*: not a mass', 'stationary', 'load.mass', '3 V');
n = refused(n, 'not a number', 'stationary', 'load.mass', 'much');
n = refused(n, 'load.mass', 'stationary', 'load.mass', '1 parsec5');
n = refused(n, 'load.mass', 'stationary', 'load.mass', '8 g; rm');
n = refused(n, 'load.mass', 'stationary', 'load.mass', '[8 g, 20 g]');
n = refused(n, 'load.mass', 'stationary', 'load.mass', 'it''s');
n = refused(n, 'load.mass', 'stationary', 'load.mass', '%s%n%d');
n = refused(n, 'load.mass', 'stationary', 'load.mass', repmat('1 g', 1, 1e5));
n = refused(n, 'load.mass', 'stationary', 'load.mass', char([195 40]));
n = refused(n, 'control character', 'stationary', 'load.mass', "8 g\n");
n = refused(n, 'control character', 'stationary', 'load.mass', "8\0 g");
n = refused(n, 'out of range', 'stationary', 'load.mass', -1);
n = refused(n, 'out of range', 'stationary', 'load.mass', 1e300);
n = refused(n, 'out of range', 'stationary', 'load.mass', intmax('int64'));
for value = {NaN, Inf, -Inf, NA, single(NaN), true}
  n = refused(n, 'load.mass', 'stationary', 'load.mass', value{1});
end
for value = {[], '', {}, cell(1, 2), {{1}}, {[1 2]}, {struct()}, eye(2), ones(1, 2, 2), 1i, [1 1i], sparse(1), ...
             sparse([1 2]), struct('a', 1), @sin, {'8 g'; @sin}, ['8 g'; '9 g'], [true false], {1, 'x y z'}, 1:30000}
  n = refused(n, 'load.mass', 'stationary', 'load.mass', value{1});
end
n = refused(n, 'whole number', 'stationary', 'mesh.nodes', 2.5);
n = refused(n, 'mesh.nodes', 'stationary', 'mesh.nodes', 3);
n = refused(n, 'electro.edges', 'stationary', 'electro.edges', 'perhaps');
n = refused(n, 'electro.model', 'stationary', 'electro.model', 'magic');
n = refused(n, 'electro.model', 'stationary', 'electro.model', 0);
n = refused(n, 'drive.table: takes a text', 'actuate', 'drive.table', [0 1; 0 1000]);
n = refused(n, 'drive.table', 'actuate', 'drive.waveform', 'table', 'drive.table', 'up and down');
n = refused(n, 'drive.table', 'actuate', 'drive.waveform', 'table', 'drive.table', repmat('1', 1, 300));
n = refused(n, 'drive.file', 'actuate', 'drive.waveform', 'table', 'drive.file', 'none.csv');
n = refused(n, 'platform', 'stationary', 'platform.length', 1);
n = refused(n, 'study', 'run', 'study', 'fly');
n = refused(n, 'combinations|values in lists', 'stationary', 'load.mass', linspace(0, 1, 2000), 'drive.voltage', 1:2000);
n = refused(n, 'calibrate', 'calibrate');

% every key: a value above, one below, one of another kind
for key = zipact('keys')'
  n = refused(n, regexptranslate('escape', key.name), 'run', key.name, @sin);
  if isempty(key.choices) && isnumeric(key.default)
    n = refused(n, regexptranslate('escape', key.name), 'run', key.name, 2 * key.max + 1);
    n = refused(n, regexptranslate('escape', key.name), 'run', key.name, key.min - 1);
  end
end

% structs of keys
keys = struct();
keys.load.mas = 1;
n = refused(n, 'did you mean load.mass', 'stationary', keys);
n = refused(n, 'takes one struct', 'stationary', repmat(struct('gravity', 1), 1, 2));
n = refused(n, 'takes one struct', 'stationary', struct('load', repmat(struct('mass', 1), 1, 2)));
n = refused(n, 'load.mass', 'stationary', struct('load', struct('mass', struct('mass', 1))));
n = refused(n, 'load', 'stationary', struct('load', 3));
n = refused(n, 'load.mass', 'stationary', struct('load', struct('mass', [])));
n = refused(n, 'takes a text', 'stationary', {});

% files
n = refused(n, 'none.yaml', 'run', 'none.yaml');
n = refused(n, '.', 'run', '');
for text = {'load.mass: 3 V', 'load.mas: 1', '{', 'study: [1]', "\0", 'mesh.nodes: [1, 2]', 'a: &a *a'}
  path = 'wrong.yaml';
  id = fopen(path, 'w');
  fwrite(id, text{1});
  fclose(id);
  n = refused(n, 'wrong.yaml', 'run', path);
end

% simulations
sim = zipact('open', 'mesh.nodes', 21);
zipact('step', sim, 1e-4);
for dt = {-1, -1e-3, 0, 1e300, NaN, Inf, '-1 ms', '1 kg', '', 'soon', [], [1 2], {}, {1e-3}, 1i, true, sparse(1), struct(), @sin}
  n = refused(n, 'dt', 'step', sim, dt{1});
end
for voltage = {-1, 1e7, NaN, '5 kg', '', [], [1 2], {}, 1i, true, struct()}
  n = refused(n, 'voltage', 'step', sim, 1e-3, voltage{1});
end
check(zipact('read', sim).time_s == 1e-4, 'what was refused has changed nothing');
n = refused(n, 'step: takes 2 to 3', 'step', sim);
n = refused(n, 'step: takes 2 to 3', 'step', sim, 1e-3, 1, 1);
n = refused(n, 'step: takes 2 to 3', 'step');
n = refused(n, 'read: takes', 'read');
n = refused(n, 'read: takes', 'read', sim, sim);
n = refused(n, 'not lists', 'open', 'load.mass', [8e-3 9e-3]);
n = refused(n, 'load.mas', 'open', 'load.mas', 1);
n = refused(n, 'contact.model', 'open', 'solver.integrator', 'implicit', 'contact.model', 'sequential');

% objects that are none, or of others
for thing = {0, 1, double(sim), uint64(0), uint64(1), sim + 1, sim - 1, intmax('uint64'), [sim sim], uint64([]), int64(sim), ...
             'sim', {sim}, struct('sim', sim), true, [], @sin, sparse(1)}
  for command = {'read', 'shape', 'save', 'close'}
    n = refused(n, '^(zipact_mex: )?simulation: ', command{1}, thing{1});
  end
  n = refused(n, 'simulation: ', 'step', thing{1}, 1e-3);
  n = refused(n, 'simulation: ', 'restore', thing{1}, zipact('save', sim));
end

% states
state = zipact('save', sim);
damaged = state;
damaged(end - 20) = bitxor(damaged(end - 20), 64);
for wrong = {[], 'text', double(state), int8(state), {state}, uint8([]), uint8(1:8), zeros(size(state), 'uint8'), ...
             state(1:end-1), [state; 1], flipud(state), damaged}
  n = refused(n, 'state: ', 'restore', sim, wrong{1});
end
for place = 1:97:numel(state)
  damaged = state;
  damaged(place) = bitxor(damaged(place), 64);
  n = refused(n, 'state: ', 'restore', sim, damaged);
end
other = zipact('open', 'mesh.nodes', 21, 'load.mass', '9 g');
n = refused(n, 'state: of another model', 'restore', other, state);
zipact('restore', sim, state);

% used up
zipact('close', sim);
for command = {'read', 'shape', 'save', 'close'}
  n = refused(n, 'simulation: is closed', command{1}, sim);
end
n = refused(n, 'simulation: is closed', 'step', sim, 1e-3);
zipact('close', other);

% numerics: the step fails, the simulation is used up until a state is restored
wild = zipact('open', 'mesh.nodes', 21, 'solver.integrator', 'explicit', 'contact.model', 'sequential', ...
              'electro.breakdown_cap', false, 'electro.force_scale', 1000);
state = zipact('save', wild);
for pattern = {'diverged', 'has diverged; restore a state'}
  try
    zipact('step', wild, 0.1, '1000 kV');
    check(false, 'did not diverge');
  catch problem
    good = strcmp(problem.identifier, 'zipact:numerics') && ~isempty(strfind(problem.message, pattern{1}));
    check(good, '%s: %s', problem.identifier, problem.message);
  end
end
zipact('read', wild); zipact('shape', wild); zipact('save', wild); % of no use, but no harm
zipact('restore', wild, state);
zipact('step', wild, 1e-6, 0);
zipact('close', wild);

% what the machine refuses
try
  zipact('run', '.');
  check(false, 'read a folder');
catch problem
  check(strcmp(problem.identifier, 'zipact:machine'), '%s', problem.message);
end

% the MEX function itself, with more results than it has
try
  [a, b] = zipact_mex('version');
  check(false, 'two results');
catch problem
  check(strcmp(problem.identifier, 'zipact:input'), '%s', problem.message);
end
for draw = {3, struct(), [], struct('series', 1, 'study', 'fly')}
  try
    zipact_plot(draw{1});
    check(false, 'drawn');
  catch problem
    check(strcmp(problem.identifier, 'zipact:input'), '%s', problem.message);
  end
end

check(n >= 60, 'only %d attempts', n);
check(zipact('stationary').good, 'all is as before');
printf('test_wrong: %d attempts refused\n', n);
