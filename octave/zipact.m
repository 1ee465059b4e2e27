function varargout = zipact(varargin)
%ZIPACT  Simulation of electrostatic zipping actuators.
varargout = zipact_mex(varargin{:});
end
