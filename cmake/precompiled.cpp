// A target of its own for the precompiled headers that all libraries share.
