// Macros that windows.h and what it includes define. A header that uses one of these names does not compile behind them. The
// standard library, GLM and Boost use some of them: what Lumis includes of those comes before.
#pragma once

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near MACRO_OF_WINDOWS_H
#define far MACRO_OF_WINDOWS_H
#define NEAR MACRO_OF_WINDOWS_H
#define FAR MACRO_OF_WINDOWS_H
#define small MACRO_OF_WINDOWS_H
#define hyper MACRO_OF_WINDOWS_H
#define interface MACRO_OF_WINDOWS_H
#define cdecl MACRO_OF_WINDOWS_H
#define pascal MACRO_OF_WINDOWS_H
#define IN MACRO_OF_WINDOWS_H
#define OUT MACRO_OF_WINDOWS_H
#define OPTIONAL MACRO_OF_WINDOWS_H
#define CONST MACRO_OF_WINDOWS_H
#define VOID MACRO_OF_WINDOWS_H
#define ERROR MACRO_OF_WINDOWS_H
#define DELETE MACRO_OF_WINDOWS_H
#define STRICT MACRO_OF_WINDOWS_H
#define TRUE MACRO_OF_WINDOWS_H
#define FALSE MACRO_OF_WINDOWS_H
#define NO_ERROR MACRO_OF_WINDOWS_H
#define ABSOLUTE MACRO_OF_WINDOWS_H
#define OPAQUE MACRO_OF_WINDOWS_H
#define TRANSPARENT MACRO_OF_WINDOWS_H
#define RGB MACRO_OF_WINDOWS_H
#define DOMAIN MACRO_OF_WINDOWS_H
#define OVERFLOW MACRO_OF_WINDOWS_H
#define UNDERFLOW MACRO_OF_WINDOWS_H
#define SING MACRO_OF_WINDOWS_H
#define PLOSS MACRO_OF_WINDOWS_H
