%ZIPACT_PLOT  Draw the result of a study into the current axes.
%
%   ZIPACT_PLOT(RESULT) draws the table of RESULT, as ZIPACT returns it: stroke over time,
%   opening or force over voltage, force along the ribbons, frequencies; of study stationary
%   the ribbons at rest; of a network the heights of its bodies, in the plane their angles. It also draws an array of
%   results of the same study.
%
%   See also ZIPACT.
function zipact_plot(result)
  if ~isstruct(result) || isempty(result) || ~isfield(result, 'series') || numel(unique({result.study})) > 1
    error('zipact:input', 'zipact_plot: takes a result of zipact, or several of one study');
  end
  [x, y, labels, style, names] = axes_of(result(1));
  held = ishold();
  for i = 1:numel(result)
    plot(x(result(i).series), y(result(i).series), style);
    hold('on');
  end
  if ~held, hold('off'); end
  xlabel(labels{1});
  ylabel(labels{2});
  grid('on');
  if ~isempty(names), legend(names, 'interpreter', 'none'); end
end

function [x, y, labels, style, names] = axes_of(result)
  style = '-';
  switch result.study
    case {'actuate', 'cycle'}
      x = @(s) 1e3 * s.time_s;     y = @(s) 1e3 * s.stroke_m;     labels = {'time / ms', 'stroke / mm'};
    case 'equilibrium'
      x = @(s) 1e-3 * s.voltage_V; y = @(s) 1e3 * s.opening_m;    labels = {'voltage / kV', 'opening / mm'};
      if all(isnan(result.series.opening_m)) % a single ribbon has none
        y = @(s) 1e3 * s.stroke_m; labels{2} = 'stroke / mm';
      end
    case 'limits'
      x = @(s) 1e-3 * s.voltage_V; y = @(s) 1e3 * s.load_kg;      labels = {'voltage / kV', 'load / g'}; style = 'o';
    case 'isometric'
      x = @(s) 1e-3 * s.voltage_V; y = @(s) s.force_N;            labels = {'voltage / kV', 'force / N'};
    case 'profile'
      x = @(s) 1e3 * s.x_m;        y = @(s) s.force_N_per_m;      labels = {'x / mm', 'force per length / (N/m)'};
    case 'modes'
      x = @(s) s.mode;             y = @(s) s.frequency_Hz;       labels = {'mode', 'frequency / Hz'}; style = 'o';
    case 'stationary'
      x = @(s) 1e3 * s.x_m;        y = @(s) 1e3 * s.y_m;          labels = {'x / mm', 'y / mm'};
    otherwise
      error('zipact:input', 'zipact_plot: there is no picture for study %s', result.study);
  end
  columns = fieldnames(result.series)';
  ending = '_y_m'; factor = 1e3; shown = 'height / mm';
  if any(~cellfun('isempty', regexp(columns, '\w_angle_rad$')))
    ending = '_angle_rad'; factor = 180 / pi; shown = 'angle / degree';
  end
  bodies = columns(~cellfun('isempty', regexp(columns, ['\w' ending '$'])));
  names = {};
  if any(strcmp(result.study, {'actuate', 'cycle', 'equilibrium'})) && ~isempty(bodies)
    y = @(s) factor * cell2mat(cellfun(@(name) s.(name), bodies, 'UniformOutput', false));
    labels{2} = shown;
    names = strrep(bodies, ending, '');
  end
end
