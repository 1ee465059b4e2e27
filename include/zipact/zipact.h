/* zipact: simulation of electrostatic zipping actuators. This header is all of the library's core;
 * files are read and written by zipact/io.h. */
#ifndef ZIPACT_ZIPACT_H
#define ZIPACT_ZIPACT_H

#include <zipact/api.h>
#include <zipact/checkpoint.h>
#include <zipact/def.h>
#include <zipact/drive.h>
#include <zipact/error.h>
#include <zipact/model.h>
#include <zipact/rest.h>
#include <zipact/sim.h>
#include <zipact/study.h>
#include <zipact/table.h>
#include <zipact/trace.h>
#include <zipact/version.h>

#endif
