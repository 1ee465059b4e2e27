% The example: the paper's Table II.
1;

ours = 1e3 * table2('table2.svg');
% by nodes 21, 61, 130: as printed, mm
published = [12.20 12.26 12.26; 16.69 16.83 16.83; 20.27 20.46 20.43; 23.58 23.34 23.31; 28.74 28.21 28.20; 31.89 31.19 31.23];
off = abs(ours ./ published - 1);
check(max(off(:)) < 0.02, 'a row is %.1f %% off', 100 * max(off(:)));
check(sum(off(:) < 0.001) >= 15, 'only %d rows within 0.1 %%', sum(off(:) < 0.001));
check(~isempty(strfind(fileread('table2.svg'), '<svg')), 'the picture');

disp('test_examples: passed');
