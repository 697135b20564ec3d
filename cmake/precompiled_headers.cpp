// Empty: what a set of precompiled headers is compiled for (SeawayPrecompiledHeaders.cmake).
