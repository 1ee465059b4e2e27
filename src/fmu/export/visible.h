/* The exports of the binary of an FMU: only the functions of the standard. */
#ifndef ZP_FMU_EXPORT_VISIBLE_H
#define ZP_FMU_EXPORT_VISIBLE_H

#if defined(_WIN32)
#define ZP_FMI __declspec(dllexport)
#elif defined(__GNUC__)
#define ZP_FMI __attribute__((visibility("default")))
#else
#define ZP_FMI
#endif

#endif
