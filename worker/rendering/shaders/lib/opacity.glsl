uniform float alpha_cutoff;

// The surface's opacity times the mesh's, from 0 to 1; what is no number is a hole.
float bounded(float surface, float mesh) {
    float opacity = surface * mesh;
    return isnan(opacity) ? 0.0 : clamp(opacity, 0.0, 1.0);
}
