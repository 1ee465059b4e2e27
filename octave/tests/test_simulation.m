% Stepping by hand: like a run, to and fro to the same bits.
1;

% All signals but the mean current and power since they were read last.
function signals = seen(sim)
  signals = rmfield(zipact('read', sim), {'current_A', 'power_W'});
end

sim = zipact('open', 'mesh.nodes', 21);
check(isa(sim, 'uint64') && isscalar(sim), 'a handle');
check(zipact('read', sim).time_s == 0, 'the start');
check(abs(zipact('step', sim, 1e-3) - 1e-3) < 1e-15, 'the time after a step');
state = zipact('save', sim);
check(isa(state, 'uint8'), 'a state');
zipact('step', sim, '2 ms', '5 kV');
there = seen(sim);
check(there.voltage_V == 5000 && abs(there.time_s - 3e-3) < 1e-15, 'a step with a voltage');
zipact('step', sim, 1e-3);
check(zipact('read', sim).voltage_V == 5000, 'the voltage holds');

check(zipact('restore', sim, state) == 1e-3, 'the time of a state');
zipact('step', sim, 2e-3, 5e3);
check(isequaln(seen(sim), there), 'on from a state, to the same bits');

% another simulation of the same actuator; both live side by side
other = zipact('open', 'mesh.nodes', 21);
check(other ~= sim && zipact('read', other).time_s == 0, 'another simulation');
zipact('restore', other, state);
zipact('step', other, 2e-3, 5e3);
check(isequaln(seen(other), there), 'on in another simulation');

% the signals are those of a run; the shape is what they say
run = zipact('actuate', 'mesh.nodes', 21, 'solver.end_time', '1 ms');
check(isequal(fieldnames(run.series), fieldnames(zipact('read', other))), 'names of the signals');
shape = zipact('shape', other);
check(isequal(size(shape.y_m), [21 2]) && abs(shape.gap_m(end) - there.opening_m) < 1e-15, 'the shape');

% a controller: asked at 0, 1 ms ...; the same as step by step, to the same bits
law = @(time, opening) 500 + 1e6 * (opening - 8e-3) * (time > 1.5e-3);
steered = zipact('open', 'mesh.nodes', 21, 'liquid.model', 'none');
by_hand = zipact('open', 'mesh.nodes', 21, 'liquid.model', 'none');
check(abs(zipact('control', steered, law, 'opening', '1 ms', '5 ms') - 5e-3) < 1e-15, 'the time after a controller');
for k = 0:4
  zipact('step', by_hand, (k + 1) * 1e-3 - k * 1e-3, law(k * 1e-3, zipact('read', by_hand).opening_m));
end
check(abs(zipact('read', steered).opening_m / zipact('read', by_hand).opening_m - 1) < 1e-9, 'as step by step');
zipact('step', steered, 1e-3, 2e3);
check(zipact('read', steered).voltage_V == 2e3, 'without the controller again');
zipact('control', steered, @(time, u) u, 'voltage', 1e-4, 0.02); % warm
started = cputime();
zipact('control', steered, @(time, u) u, 'voltage', 1e-6, 0.04);
with = cputime() - started;
printf('%.1f us a sample, with the step that it cuts\n', with / 0.02);
zipact('close', steered);
zipact('close', by_hand);

% closed ones are gone, the others stay
zipact('close', sim);
check(zipact('read', other).time_s == there.time_s, 'the other one is open');
zipact('close', other);

% cleared with simulations open: nothing is left, and an old handle is not taken for a new one
old = zipact('open', 'mesh.nodes', 21);
clear zipact_mex
new = zipact('open', 'mesh.nodes', 21);
try
  zipact('read', old);
  check(false, 'an old handle was taken');
catch problem
  check(strcmp(problem.identifier, 'zipact:input'), '%s', problem.message);
end
zipact('close', new);

% many, closed in any order
many = arrayfun(@(i) zipact('open', 'mesh.nodes', 21), 1:20);
check(numel(unique(many)) == 20, 'handles differ');
for i = randperm(20), zipact('close', many(i)); end

% Ctrl-C stops a long call, and only this
% once Octave has computed for half a second more, which it does in that call
system(sprintf(['(used() { cut -d " " -f 14 /proc/%d/stat; }; till=$(($(used) + 50)); ' ...
                'while [ "$(used)" -lt $till ]; do sleep 0.05; done; kill -INT %d) &'], getpid(), getpid()));
try
  zipact('actuate', 'solver.integrator', 'explicit', 'contact.model', 'sequential', 'drive.voltage', '2 kV', ...
         'solver.end_time', 1000);
  check(false, 'was not stopped');
catch problem
  check(strcmp(problem.identifier, 'zipact:interrupted'), '%s', problem.message);
end

% after a call Ctrl-C belongs to Octave again
[~, printed] = system(sprintf('"%s" --no-init-file --path "%s" --eval "zipact(''stationary''); disp(''called''); kill(getpid(), SIG().INT); pause(2); disp(''went on'')"', ...
                              fullfile(OCTAVE_HOME, 'bin', 'octave-cli'), fileparts(which('zipact'))));
check(~isempty(strfind(printed, 'called')) && isempty(strfind(printed, 'went on')), '%s', printed);

% pictures of every study that has one
graphics_toolkit('gnuplot');
figure('visible', 'off');
for study = {'stationary', 'equilibrium', 'isometric', 'profile', 'modes', 'actuate'}
  clf();
  zipact_plot(zipact(study{1}, 'mesh.nodes', 21));
  lines = findobj(gca(), 'type', 'line');
  check(numel(lines) >= 1 && numel(get(lines(1), 'xdata')) > 3, 'picture of %s', study{1});
end
clf();
limits = zipact('limits', 'mesh.nodes', 21);
zipact_plot(limits);
drawn = arrayfun(@(line) any(get(line, 'xdata')(:) == 1e-3 * limits.series.voltage_V(end)), findobj(gca(), 'type', 'line'));
check(any(drawn), 'voltages of the limits, in kV');
clf();
zipact_plot(zipact('equilibrium', 'actuator.kind', 'ribbon', 'mesh.nodes', 21));
check(all(isfinite(get(findobj(gca(), 'type', 'line')(1), 'ydata'))), 'picture of a ribbon, by its stroke');
close('all');

disp('test_simulation: passed');
