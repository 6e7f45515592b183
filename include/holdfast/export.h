/* Holdfast: what a shared library exports. Everything else is built with hidden visibility. */
#ifndef HOLDFAST_EXPORT_H
#define HOLDFAST_EXPORT_H

#if defined(_WIN32)
#if defined(HOLDFAST_BUILDING_SHARED)
#define HOLDFAST_API __declspec(dllexport)
#elif defined(HOLDFAST_SHARED)
#define HOLDFAST_API __declspec(dllimport)
#else
#define HOLDFAST_API
#endif
#else
#define HOLDFAST_API __attribute__((visibility("default")))
#endif

#endif
