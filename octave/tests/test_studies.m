% Every study: the command's numbers to the last bit, as structs.
1;

same_as_the_command('stationary', '');
same_as_the_command('equilibrium', ' --set "load.mass=20 g" --set drive.voltage=6000', ...
                    'load.mass', '20 g', 'drive.voltage', 6e3);
same_as_the_command('limits', ' --set mesh.nodes=31', 'mesh.nodes', int32(31));
same_as_the_command('isometric', ' --set "isometric.separation=3 mm"', 'isometric.separation', '3 mm');
same_as_the_command('modes', ' --set mesh.nodes=21', 'mesh.nodes', int32(21));
modes = zipact('modes', 'mesh.nodes', 21);
check(isequal(modes.frequencies_Hz, modes.series.frequency_Hz), 'frequencies');
same_as_the_command('cycle', ' --set mesh.nodes=11 --set drive.waveform=sine --set drive.voltage=3000', ...
                    'mesh.nodes', 11, 'drive.waveform', 'sine', 'drive.voltage', 3e3);
same_as_the_command('actuate', ' --set mesh.nodes=21', 'mesh.nodes', single(21));

data = fullfile(fileparts(mfilename('fullpath')), '..', '..', 'examples');
fit = fullfile(data, 'calibrate-modulus.yaml');
same_as_the_command('calibrate', [' "' fit '"'], fit);

% actuators in series, antagonists
same_as_the_command('equilibrium', ' --set stack.series=2 --set mesh.nodes=21', 'stack.series', 2, 'mesh.nodes', 21);
same_as_the_command('modes', ' --set stack.series=2 --set mesh.nodes=21', 'stack.series', 2, 'mesh.nodes', 21);
pair = {'stack.series', 2, 'stack.distance', '20 mm', 'stack.voltage_ratio', 0, 'load.mass', '1 g', 'mesh.nodes', 21};
held = zipact('stationary', pair{:});
check(abs(held.opening_m + held.lower_opening_m - 0.02) < 1e-11 && held.stiffness_N_per_m > 0, 'antagonists at rest');
path = zipact('equilibrium', pair{:}, 'drive.voltage', '5 kV');
check(path.release_voltage_V < path.pull_in_voltage_V && path.closing_voltage_V < 5e3, 'antagonists close and open');
same_as_the_command('limits', ' --set stack.series=2 --set "stack.distance=20 mm" --set mesh.nodes=21 --set load.mass=1g', ...
                    'stack.series', 2, 'stack.distance', '20 mm', 'mesh.nodes', 21, 'load.mass', '1 g');
same_as_the_command('modes', ' --set stack.parallel=2 --set "member_2.ribbon.thickness=80 um" --set mesh.nodes=21', ...
                    'stack.parallel', 2, 'member_2.ribbon.thickness', '80 um', 'mesh.nodes', 21);
whole = {'actuator.symmetry', 'none', 'platform.rotates', true, 'platform.electrode', false, 'liquid.model', 'none', 'mesh.nodes', 21};
left = zipact('stationary', whole{:}, 'actuator.held_clip', 'left');
right = zipact('stationary', whole{:}, 'actuator.held_clip', 'right');
check(abs(left.angle_rad + right.angle_rad) < 1e-9 && left.angle_rad ~= 0, 'a held clip');

% a file, a struct and pairs say the same, in this order
file = fullfile(pwd, 'mine.yaml');
id = fopen(file, 'w');
fputs(id, "study: stationary\nload.mass: 20 g\nmesh.nodes: 21\n");
fclose(id);
keys.load.mass = '20 g';
keys.mesh.nodes = 21;
ours = zipact('stationary', 'load.mass', 0.02, 'mesh.nodes', '21');
check(isequaln(ours, zipact('run', file)), 'a file');
check(isequaln(ours, zipact('stationary', keys)), 'a struct');
check(isequaln(ours, zipact('run', ours.definition)), 'its own definition');
check(ours.stroke_m > zipact('run', file, 'load.mass', '8 g').stroke_m, 'pairs after a file');

check(numel(zipact('equilibrium', 'insulator.thickness', '10 um', 'mesh.nodes', 31).notes) == 1, 'breakdown is noted');

slopes = zipact('stationary', keys, 'sensitivity.by', 'ribbon.thickness, gravity').sensitivity;
check(slopes.stroke_m.ribbon_thickness < 0 && slopes.opening_m.gravity > 0, 'derivatives');
check(~isfield(ours, 'sensitivity'), 'no derivatives');

% lists: the product, the last key of the table of keys fastest, as the command has it
runs = zipact('stationary', 'mesh.nodes', [21 31], 'load.mass', {'8 g', 0.02});
check(isequal(size(runs), [1 4]), 'size of a sweep');
swept = arrayfun(@(r) [r.definition.load.mass r.definition.mesh.nodes], runs, 'UniformOutput', false);
check(isequal(vertcat(swept{:}), [8e-3 21; 8e-3 31; 20e-3 21; 20e-3 31]), 'order of a sweep');
check(runs(3).stroke_m == ours.stroke_m, 'a run of a sweep');
check(isequal(fieldnames(zipact('stationary', 'load.mass', {0.02}).series), fieldnames(ours.series)), 'a list of one');

% shapes: nodes x ribbons x frames
moved = zipact('actuate', 'mesh.nodes', 21);
shapes = moved.shapes;
frames = numel(shapes.time_s);
check(frames > 10 && isequal(size(shapes.y_m), [21 2 frames]) && isequal(size(shapes.gap_m), [21 frames]), 'shapes');
gap = squeeze(shapes.y_m(:, 1, :) - shapes.y_m(:, 2, :));
check(max(abs(gap(:) - shapes.gap_m(:))) < 1e-12, 'the gap is the distance of the ribbons');
check(isequal(size(shapes.stress_Pa), size(shapes.x_m)) && max(shapes.stress_Pa(:)) <= moved.max_stress_Pa, 'stress');
check(isequal(size(shapes.insulator_field_V_per_m), size(shapes.gap_m)), 'field in the insulators');
alone = zipact('stationary', 'actuator.kind', 'ribbon');
check(size(alone.shapes.x_m, 2) == 1 && ~isfield(alone.shapes, 'gap_m'), 'one ribbon alone');
check(isequal(size(alone.shapes.stress_Pa), size(alone.shapes.x_m)) && max(alone.shapes.stress_Pa) == alone.max_stress_Pa, 'its stress');

% each frame is what the command writes for ParaView
same_as_the_command('actuate', ' --set mesh.nodes=11 --set output.shapes=4 --set "solver.end_time=10 ms"', 'mesh.nodes', 11, ...
                    'output.shapes', 4, 'solver.end_time', '10 ms');
shapes = zipact('actuate', 'mesh.nodes', 11, 'output.shapes', 4, 'solver.end_time', '10 ms').shapes;
for frame = 1:numel(shapes.time_s)
  file = fullfile(pwd, 'out', 'shapes', sprintf('shape_%04d.vtp', frame - 1));
  points = reshape(from_vtk(file, 'Points'), 3, 11, 2); % axis, node, ribbon
  check(isequal(squeeze(points(1, :, :)), shapes.x_m(:, :, frame)) && isequal(squeeze(points(2, :, :)), shapes.y_m(:, :, frame)), 'points');
  check(isequal(reshape(from_vtk(file, 'stress'), 11, 2), shapes.stress_Pa(:, :, frame)), 'stress of a frame');
  for pairs = {'gap', 'gap_m'; 'line_force', 'line_force_N_per_m'; 'insulator_field', 'insulator_field_V_per_m'}'
    check(isequal(from_vtk(file, pairs{1})(1:11), shapes.(pairs{2})(:, frame)), '%s of a frame', pairs{1});
  end
end
collection = regexp(fileread(fullfile(pwd, 'out', 'shapes.pvd')), 'timestep="([^"]*)"', 'tokens');
check(isequal(str2double(vertcat(collection{:})), shapes.time_s(:)), 'times of frames');
check(shapes.voltage_V(end) == 1e4, 'voltage of a frame');

% the map of the field: rows go upwards, columns along
field = zipact('profile', 'electro.model', 'field').field;
inside = all(all(diff(field.x_m, 1, 2) > 0));
check(inside && isequal(size(field.strength_V_per_m), size(field.x_m) - 1), 'the map of the field');
same_as_the_command('profile', ' --set electro.model=field', 'electro.model', 'field');
file = fullfile(pwd, 'out', 'field.vts');
for pairs = {'potential', 'potential_V'; 'field_strength', 'strength_V_per_m'; 'permittivity', 'permittivity'}'
  check(isequal(from_vtk(file, pairs{1}), field.(pairs{2})(:)), '%s of the field', pairs{1});
end
points = reshape(from_vtk(file, 'Points'), 3, []);
check(isequal(points(1:2, :), [field.x_m(:)'; field.y_m(:)']), 'nodes of the field');

% keys, text keys, quotes
keys = zipact('keys');
mass = keys(strcmp({keys.name}, 'load.mass'));
check(strcmp(mass.unit, 'kg') && mass.default == 8e-3 && mass.max == 1e3, 'the table of keys');
study = keys(strcmp({keys.name}, 'study'));
check(any(strcmp(study.choices, 'modes')) && strcmp(study.default, 'actuate'), 'words of a key');
[~, listed] = system(sprintf('"%s" keys --json', getenv('ZIPACT_COMMAND')));
listed = jsondecode(listed);
for i = 1:numel(keys)
  theirs = listed(i);
  check(strcmp(keys(i).name, theirs.key), 'key %d', i);
  if ~isempty(theirs.choices), check(isequal(keys(i).choices(:)', {theirs.choices.word}), 'words of %s', theirs.key); end
  if ~isempty(theirs.min)
    check(all(abs([keys(i).min keys(i).max] - [theirs.min theirs.max]) <= 1e-14 * abs([theirs.min theirs.max])), 'range of %s', theirs.key);
  end
end
table = '0 ms = 0 kV, 1 ms = 2 kV';
driven = zipact('actuate', 'drive.waveform', 'table', 'drive.table', table, 'solver.end_time', '2 ms', 'mesh.nodes', 21);
definition = zipact('stationary', 'mesh.nodes', 11, 'load.mass', pi / 100, 'calibrate.fit', 'it''s').definition;
check(definition.load.mass == pi / 100 && strcmp(definition.calibrate.fit, 'it''s'), 'numbers and texts arrive as they are');
check(strcmp(definition.solver.time_step, 'auto'), 'an automatic key');
check(strcmp(driven.definition.drive.table, table) && driven.series.voltage_V(end) == 2000, 'a text key');

% what failed is returned, and says so
short = zipact('actuate', 'mesh.nodes', 21, 'solver.max_steps', 3);
check(~short.good && strcmp(short.outcome, 'step_limit'), 'a run that failed');

disp('test_studies: passed');
