%ZIPACT  Simulation of electrostatic zipping actuators: studies, and stepping by hand.
%
%   RESULT = ZIPACT(STUDY, KEY, VALUE, ...) runs a study: stationary, equilibrium, limits,
%   isometric, profile, modes, actuate, cycle, calibrate or plan.
%
%      rest = zipact('equilibrium', 'load.mass', '20 g', 'drive.voltage', 6e3)
%      rest.release_voltage_V                      % a number of summary.json
%      plot(rest.series.voltage_V, rest.series.opening_m)
%
%   Numbers are SI, texts have a unit. A vector or a cell of values runs all of them:
%   RESULT is then an array of structs, one for each combination.
%
%      all = zipact('isometric', 'drive.voltage', {'4 kV', '6 kV'}, 'load.mass', [8e-3 20e-3]);
%      [all.force_N]
%
%   ZIPACT(STUDY, FILE, ...) takes a scenario file first, ZIPACT(STUDY, KEYS, ...) a struct:
%   keys.load.mass = '20 g'. ZIPACT('run', FILE) runs the study that the file names.
%
%   A network has structs of its bodies, joints, members and springs by name, with their keys:
%
%      arm.bodies.hand.mass = '20 g';
%      arm.members.left = struct('upper', 'frame', 'lower', 'hand');
%      arm.springs.rope.between = {'frame', 'hand'};
%      moved = zipact('actuate', arm, 'members.left.ribbon.thickness', '60 um');
%      moved.members.left.zip_time_s, moved.series.hand_y_m
%
%   Fields of RESULT: study, outcome, good (false if the solver failed), message, notes, the
%   numbers of the study, and if they exist
%      sensitivity derivatives with respect to the keys of sensitivity.by:
%                  sensitivity.stroke_m.ribbon_thickness
%      series      table.csv: a column vector for each column
%      shapes      time_s, voltage_V, zipped, x_m, y_m and stress_Pa [nodes x ribbons x
%                  frames], gap_m, line_force_N_per_m and insulator_field_V_per_m [nodes x frames]
%      field       the electric field of study profile, for contourf
%      bodies, members   of a network: structs of the numbers of each
%      definition  all keys with their values: ZIPACT accepts it again. ('auto': chosen by the library;
%                  of a network member_1, body_1, ... in the place of names)
%
%   KEYS = ZIPACT('keys')           all keys: name, unit, default, min, max, choices, help
%   TEXT = ZIPACT('version')
%
%   Stepping by hand:
%      sim = zipact('open', KEY, VALUE, ...)       % or FILE, or a struct, as above
%      time = zipact('step', sim, dt)              % s, or a text as '1 ms'
%      time = zipact('step', sim, dt, voltage)     % V; holds from now on
%      zipact('input', sim, 'load', 0.05)          % an input holds until it is set again, SI
%      zipact('input', sim, 'left.voltage', 5e3, 1e5)    % of a network's member or body; changes
%                                                  % by 1e5 V/s
%      zipact('inputs', sim)                       % name and unit of each input
%      time = zipact('control', sim, @(time, opening) 1e6 * (opening - 8e-3), 'opening', 1e-3, 0.5)
%                                                  % a controller: called now and every 1 ms
%                                                  % until 0.5 s; it returns the voltage
%      now = zipact('read', sim)                   % all signals: now.stroke_m, now.hand_y_m ...
%      shape = zipact('shape', sim)                % as in RESULT.shapes, one frame
%      state = zipact('save', sim)                 % bytes; for the same actuator only
%      time = zipact('restore', sim, state)        % resumes there, with identical bits
%      zipact('close', sim)
%
%   Errors are zipact:input (the message says what is wrong and what is allowed),
%   zipact:numerics (the solver failed in a step), zipact:machine (memory, files),
%   zipact:interrupted (Ctrl-C). A study whose solver fails returns the results up to there:
%   check RESULT.good.
%
%   See also ZIPACT_PLOT.
function varargout = zipact(varargin)
  if nargin > 2 && isequal(varargin{1}, 'control') && isa(varargin{3}, 'function_handle')
    law = varargin{3};
    varargin{3} = @(time, signal) asked(law, time, signal);
  end
  varargout = zipact_mex(varargin{:});
end

% The voltage of a controller, or its error, which must not pass through the library.
function [voltage, problem] = asked(law, time, signal)
  problem = '';
  try
    voltage = law(time, signal);
  catch caught
    voltage = NaN;
    problem = caught.message;
  end
end
