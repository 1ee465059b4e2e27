% What computes at length.
1;

fit = fullfile(fileparts(mfilename('fullpath')), '..', '..', 'examples', 'calibrate-bench.yaml');
same_as_the_command('calibrate', [' "' fit '" --set mesh.nodes=15'], fit, 'mesh.nodes', 15);

disp('nightly_studies: passed');
