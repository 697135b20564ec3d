// Empty: what the precompiled headers are compiled for (SeawayPrecompiledHeaders.cmake).
