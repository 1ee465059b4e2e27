% from_vtk(PATH, NAME): the numbers of an array in a file for ParaView, as a column.
function value = from_vtk(path, name)
  id = fopen(path);
  bytes = fread(id, Inf, '*uint8')';
  fclose(id);
  start = strfind(char(bytes), '<AppendedData')(1);
  start += find(bytes(start:end) == '_', 1);
  offset = regexp(char(bytes(1:start - 1)), sprintf('Name="%s"[^>]*offset="(\\d+)"', name), 'tokens'){1}{1};
  at = start + str2double(offset);
  value = typecast(bytes(at + 8 + (0:double(typecast(bytes(at + (0:7)), 'uint64')) - 1)), 'double')';
end
