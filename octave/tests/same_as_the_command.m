% same_as_the_command(STUDY, OPTIONS, ARGUMENTS...): the result of zipact(STUDY, ARGUMENTS...) has the numbers of the command
% with OPTIONS to the last bit.
function same_as_the_command(study, options, varargin)
  [summary, names, rows] = command([study options]);
  result = zipact(study, varargin{:});
  check(strcmp(result.message, summary.message) && strcmp(result.outcome, summary.outcome), '%s: message', study);
  check(isequal(fieldnames(result.series)', regexprep(names, '\W', '_')), '%s: columns', study);
  columns = struct2cell(result.series);
  check(isequaln([columns{:}], rows), '%s: rows', study);
  told = 0;
  for name = fieldnames(summary)'
    theirs = summary.(name{1});
    if any(strcmp(name{1}, {'wall_time_s', 'real_time_factor', 'version', 'notes', 'outcome', 'message', 'frequencies_Hz'}))
      continue
    end
    if isempty(theirs), theirs = NaN; end % null
    if isnumeric(theirs) && isfield(result, name{1})
      check(isequaln(theirs, result.(name{1})), '%s: %s', study, name{1});
      told++;
    end
  end
  check(told > 0 || strcmp(study, 'modes'), '%s: no number compared', study);
end

% jsondecode of Octave 7 loses last bits of numbers, so these are read from the text.
function [summary, names, rows] = command(arguments)
  folder = fullfile(pwd, 'out');
  [~, text] = system(sprintf('"%s" %s -o "%s" --json --quiet --no-plots', getenv('ZIPACT_COMMAND'), arguments, folder));
  summary = jsondecode(text);
  for number = regexp(text, '"([\w.]+)": (-?[\d.][\d.e+-]*)', 'tokens')
    name = strrep(number{1}{1}, '.', '_'); % as jsondecode names a key
    if isfield(summary, name), summary.(name) = str2double(number{1}{2}); end
  end
  lines = strsplit(strtrim(fileread(fullfile(folder, 'table.csv'))), "\n");
  names = strsplit(lines{1}, ',');
  cells = cellfun(@(line) strsplit(line, ',', 'CollapseDelimiters', false), lines(2:end), 'UniformOutput', false);
  rows = str2double(vertcat(cells{:})); % an empty cell is NaN
end
