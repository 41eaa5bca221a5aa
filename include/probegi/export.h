#pragma once

/// PROBEGI_API marks what a shared ProbeGI shows to programs, whatever visibility they compile with.
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
