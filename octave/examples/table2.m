% The paper's Table II: stroke of the hanging actuator under six loads, for three numbers of nodes, by the authors'
% model (preset paper-code) with the shear springs K_S that they calibrated at 61 g. Ours beside theirs.
%
%   ours = table2()         prints it; ours: [loads x nodes] m
%   table2('strokes.svg')   draws it, too
function ours = table2(picture)
  nodes = [21 61 130];
  load_g = [40 60 80 100 150 200];
  [table, shear] = published();
  ours = zeros(numel(load_g), numel(nodes));
  for i = 1:numel(nodes)
    rest = zipact('stationary', 'preset', 'paper-code', 'mesh.nodes', nodes(i), ...
                  'mass_spring.shear_coefficient', shear(nodes(i)), 'load.mass', load_g / 1000);
    ours(:, i) = [rest.stroke_m];
  end
  printf_row = '%5d  %6.0f  %12.2f  %10.3f  %+10.3f\n';
  fprintf('nodes  load/g  published/mm     ours/mm  difference/mm\n');
  for row = table.'
    stroke = 1e3 * ours(load_g == row(2), nodes == row(1));
    fprintf(printf_row, row(1), row(2), row(3), stroke, stroke - row(3));
  end
  if nargin, draw(picture, table, nodes, load_g, 1e3 * ours); end
end

% Rows of nodes, load/g, stroke/mm, finite elements/mm; K_S of N nodes, N/m. From where zipact reproduce has them.
function [table, shear] = published()
  here = fileparts(mfilename('fullpath'));
  text = fileread(fullfile(here, '..', '..', 'reproduce', 'published.def'));
  numbers = @(pattern) cellfun(@str2double, vertcat_all(regexp(text, pattern, 'tokens')));
  table = numbers('ZP_TABLE_2\((\d+), (\d+), ([\d.]+), ([\d.]+),');
  saved = numbers('ZP_SAVED_SHEAR, (\d+), 61, ([\d.e]+)\)');
  shear = @(n) saved(saved(:, 1) == n, 2);
end

function all = vertcat_all(rows)
  all = vertcat(rows{:});
end

function draw(picture, table, nodes, load_g, ours)
  figure('visible', 'off');
  colours = [0 0.447 0.698; 0.835 0.369 0; 0 0.62 0.451];
  hold('on');
  for i = 1:numel(nodes)
    theirs = table(table(:, 1) == nodes(i), :);
    plot(load_g, ours(:, i), '-', 'linewidth', 2, 'color', colours(i, :), 'displayname', sprintf('zipact, N = %d', nodes(i)));
    plot(theirs(:, 2), theirs(:, 3), 'o', 'markersize', 5, 'linewidth', 1, 'color', colours(i, :), 'displayname', sprintf('Table II, N = %d', nodes(i)));
  end
  elements = table(table(:, 1) == nodes(1), :);
  plot(elements(:, 2), elements(:, 4), 'k--', 'linewidth', 2, 'displayname', 'Table II, finite elements');
  xlabel('load / g');
  ylabel('stroke / mm');
  grid('on');
  legend('location', 'southeast');
  print(picture, '-dsvg');
  close();
end
