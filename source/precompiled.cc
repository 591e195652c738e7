// Carries the precompiled header shared by all layers.
