#pragma once

/// PROBEGI_API marks the symbols that a shared ProbeGI exports, whatever visibility the program is compiled with.
#if defined(_WIN32)
#if defined(PROBEGI_BUILDS_SHARED)
#define PROBEGI_API __declspec(dllexport)
#elif defined(PROBEGI_SHARED)
#define PROBEGI_API __declspec(dllimport)
#else
#define PROBEGI_API
#endif
#else
#define PROBEGI_API __attribute__((visibility("default")))
#endif
