% Networks: structs of bodies, joints, members and springs give the numbers of the file.
1;

file = fullfile(fileparts(mfilename('fullpath')), '..', '..', 'examples', 'network.yaml');
short = {'mesh.nodes', 11, 'solver.end_time', '10 ms'};

network.drive.voltage = '10 kV';
network.solver.stop_when_zipped = false;
network.bodies.bar.mass = '4 g';
network.bodies.left_hand.mass = 6e-3;
network.bodies.right_hand.mass = '8 g';
network.members.lift_1 = struct('upper', 'frame', 'lower', 'bar');
network.members.lift_2 = struct('upper', 'frame', 'lower', 'bar');
network.members.lift_2.ribbon.thickness = '60 um';
network.members.left = struct('upper', 'bar', 'lower', 'left_hand');
network.members.right = struct('upper', 'bar', 'lower', 'right_hand');
network.members.right.drive.voltage = 8e3;
network.springs.rope = struct('stiffness', '2 N/m', 'rest', 15e-3, 'kind', 'pull');
network.springs.rope.between = {'frame', 'bar'};

for study = {'actuate', 'stationary', 'modes'}
  ours = zipact(study{1}, network, short{:});
  theirs = zipact(study{1}, file, short{:});
  check(isequaln(ours.series, theirs.series) && isequaln(ours.shapes, theirs.shapes), 'the file, %s', study{1});
end

moved = zipact('actuate', network, short{:});
check(isequal(fieldnames(moved.members)', {'lift_1', 'lift_2', 'left', 'right'}), 'members');
check(moved.bodies.bar.y_m == moved.series.bar_y_m(end) && moved.bodies.bar.y_m == -moved.members.lift_2.opening_m, 'a height');
check(isnan(moved.members.left.zip_time_s), 'a time');

graphics_toolkit('gnuplot');
figure('visible', 'off');
zipact_plot(moved);
lines = findobj(gca(), 'type', 'line');
check(numel(lines) == 3 && isequal(get(lines(end), 'ydata')(:), 1e3 * moved.series.bar_y_m), 'heights are drawn');
check(isequal(get(legend(), 'string'), {'bar', 'left_hand', 'right_hand'}), 'a legend');
close('all');

% a joint
plane.mesh.nodes = 11;
plane.bodies.arm = struct('moves', 'plane', 'mass', '12 g', 'inertia', '2000 g mm2');
plane.bodies.arm.at = {0, '-8 mm'};
plane.joints.pivot.type = 'pin';
plane.joints.pivot.between = {'frame', 'arm'};
plane.joints.pivot.at = {0, '6 mm'};
plane.members.left = struct('upper', 'frame', 'lower', 'arm');
plane.members.left.upper_at = {'-60 mm', 0};
plane.members.left.lower_at = {'-60 mm', 0};
turned = zipact('stationary', plane, 'bodies.arm.torque', '1 mN m');
still = zipact('stationary', plane);
figure('visible', 'off');
zipact_plot(zipact('actuate', plane, 'solver.end_time', '2 ms'));
check(strcmp(get(get(gca(), 'ylabel'), 'string'), 'angle / degree') && isequal(get(legend(), 'string'), {'arm'}), 'angles are drawn');
close('all');
check(turned.bodies.arm.angle_rad > still.bodies.arm.angle_rad + 1e-3, 'a torque turns a body on its pin');

% by pairs, over a file, in lists
other = zipact('stationary', file, 'mesh.nodes', 11, 'members.lift_2.ribbon.thickness', 50e-6);
pairs = zipact('stationary', network, 'mesh.nodes', 11, 'members.lift_2', struct('ribbon', struct('thickness', '50 um')));
check(isequal(other.bodies, pairs.bodies), 'pairs');
lists = zipact('stationary', network, 'mesh.nodes', 11, 'members.lift_2.ribbon.thickness', {'50 um', 60e-6});
check(numel(lists) == 2 && isequal(lists(1).bodies, other.bodies) && ~isequal(lists(2).bodies, other.bodies), 'lists');
again = zipact('run', moved.definition);
check(isequaln(struct2cell(again.series), struct2cell(moved.series)), 'its own definition');

% a mount, a force, a body without mass
arm.mesh.nodes = 11;
arm.bodies.hand.mass = '20 g';
arm.bodies.middle = struct();
arm.bodies.floor.at = [0 -0.06];
arm.bodies.floor.moves = 'none';
arm.members.left = struct('upper', 'frame', 'lower', 'hand');
arm.members.down = struct('upper', 'floor', 'lower', 'middle', 'angle', '180 degree');
arm.springs.link.between = {'middle', 'hand'};
arm.springs.link.stiffness = 20;
arm.springs.link.rest = '2 mm';
free = zipact('stationary', arm);
pushed = zipact('stationary', arm, 'bodies.hand.force', {0, '20 mN'});
check(free.good && pushed.bodies.hand.y_m > free.bodies.hand.y_m + 1e-4, 'a force');

% stepping by hand goes the same way, with numbers of members and bodies
short = {'mesh.nodes', 11, 'solver.time_step', '100 us'};
run = zipact('actuate', network, short{:}, 'solver.end_time', '4 ms');
sim = zipact('open', network, short{:});
zipact('step', sim, '4 ms');
now = zipact('read', sim);
check(isequal(fieldnames(run.series), fieldnames(now)), 'names of the signals');
last = cellfun(@(column) column(end), struct2cell(rmfield(run.series, {'current_A', 'power_W'})), 'UniformOutput', false);
check(isequaln(last, struct2cell(rmfield(now, {'current_A', 'power_W'}))), 'as the study, to the same bits');
check(isequaln(zipact('shape', sim).y_m, run.shapes.y_m(:, :, end)), 'shapes of all members');
zipact('close', sim);

% inputs by name
fingers = fullfile(fileparts(file), 'ports.yaml');
sim = zipact('open', fingers, 'mesh.nodes', 11);
inputs = zipact('inputs', sim);
check(isequal({inputs.name}, {'voltage', 'b.voltage', 'c.setpoint', 'thumb.force_y', 'finger.force_y', 'wrist.force_y'}), 'inputs');
check(isequal({inputs.unit}, {'V', 'V', '1', 'N', 'N', 'N'}), 'units of inputs');
height = zipact('read', sim).wrist_y_m;
zipact('input', sim, 'voltage', 2e3);
zipact('input', sim, 'b.voltage', 3e3, 1e5);
zipact('input', sim, 'wrist.force_y', 0.1);
zipact('step', sim, '10 ms');
now = zipact('read', sim);
check(now.a_voltage_V == 2e3 && abs(now.b_voltage_V / 4e3 - 1) < 1e-12 && now.wrist_y_m > height + 1e-4, 'inputs act');
wrong = {{'b.volt', 1}, 'b.volt: unknown input; did you mean b.voltage?';
         {'load', 1}, 'load: the network has no such input';
         {'wrist.force_y', 1e5}, 'wrist.force_y = 100000 is out of range';
         {'voltage', 'high'}, 'value: takes one number';
         {'voltage', 1, [1 2]}, 'rate: takes one number';
         {'voltage'}, 'input: takes 3 to 4 arguments';
         {3, 1}, 'input: '};
for k = 1:rows(wrong)
  try
    zipact('input', sim, wrong{k, 1}{:});
    check(false, 'was taken: %s', wrong{k, 2});
  catch problem
    told = strrep(problem.message, 'zipact_mex: ', '');
    check(strcmp(problem.identifier, 'zipact:input') && strncmp(told, wrong{k, 2}, numel(wrong{k, 2})), '%s', told);
  end
end
zipact('close', sim);

% a controller reads a body
sim = zipact('open', arm, 'liquid.model', 'none');
zipact('control', sim, @(time, y) 1e3 * (y < 0), 'hand.y', '1 ms', '3 ms');
check(zipact('read', sim).left_voltage_V == 1e3, 'a controller of a height');
zipact('close', sim);

% what is wrong
function refuse(message, key, value)
  keys.bodies.hand.mass = '20 g';
  keys.members.left = struct('upper', 'frame', 'lower', 'hand');
  try
    zipact('stationary', keys, 'mesh.nodes', 11, key, value);
  catch problem
    told = strrep(problem.message, 'zipact_mex: ', '');
    check(strcmp(problem.identifier, 'zipact:input') && strncmp(told, message, numel(message)), '%s: %s', key, told);
    return
  end
  error('test:failed', '%s: was taken', key);
end

refuse('members.left.ribon.thickness: unknown key; did you mean members.left.ribbon.thickness?', 'members.left.ribon.thickness', 1);
refuse('members.left.ribbon.thickness = "3 V": not a length', 'members.left', struct('ribbon', struct('thickness', '3 V')));
refuse('members.left.ribbon.thickness: takes a number', 'members.left', struct('ribbon', struct('thickness', @sin)));
refuse('members.left.ribbon: takes one struct', 'members.left', struct('ribbon', repmat(struct('thickness', 1), 1, 2)));
refuse('members.left.upper = nobody: there is no such body', 'members.left.upper', 'nobody');
refuse('members.left: takes', 'members.left', []);
refuse('members: takes', 'members', 3);
refuse('members.hand.upper: hand is a name in bodies already', 'members.hand.upper', 'frame');
refuse('bodies.Hand.mass: "Hand" is no name', 'bodies.Hand.mass', 1);
refuse('bodies.free: nothing holds it', 'bodies.free', struct());
refuse('springs.rope.between: takes two values', 'springs.rope.between', {'frame'});
refuse('springs.rope.between: nobody is not given in bodies', 'springs.rope', struct('between', {{'frame', 'nobody'}}, 'stiffness', 1));

disp('test_network: passed');
