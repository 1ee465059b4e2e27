% check(CONDITION, MESSAGE, ...): an error with the message where the condition does not hold.
function check(condition, varargin)
  if ~condition, error('test:failed', varargin{:}); end
end
