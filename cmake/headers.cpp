// The precompiled headers want a source; it has nothing of its own.
