% What a sample of a controller of one's own costs from Octave beyond the steps themselves:
%
%   octave-cli --path BUILD/octave octave/benchmarks/control.m
%
% The same explicit steps with a controller that does nothing, one sample a step, and in one call without any; best of
% several rounds. What Octave itself takes to call a function handle is part of the controller.

1;

function best = best_of(rounds, work)
  best = Inf;
  for k = 1:rounds
    start = tic;
    work();
    best = min(best, toc(start));
  end
end

function call(law, many)
  for k = 1:many
    law(0, 0);
  end
end

period = 1e-6;
many = 2000;
rounds = 40;
sim = zipact('open', 'preset', 'paper-code', 'mesh.nodes', 21, 'drive.voltage', 0, 'solver.time_step', period);
voltage = zipact('read', sim).voltage_V;
law = @(time, signal) voltage;
in_c = 1e6 / many * best_of(rounds, @() zipact('step', sim, many * period));
sampled = 1e6 / many * best_of(rounds, @() zipact('control', sim, law, 'opening', period, zipact('read', sim).time_s + many * period));
own = 1e6 / many * best_of(rounds, @() call(law, many));
printf('step in C                       %7.3f us\n', in_c);
printf('step that begins with a sample  %7.3f us\n', sampled);
printf('the controller''s own call       %7.3f us, in an Octave loop\n', own);
printf('a sample beyond the controller  %7.3f us\n', sampled - in_c - own);
zipact('close', sim);
