
layout(binding = 1) uniform sampler2DArray irradianceMaps;
uniform float mapUnit;      // lx per unit of a stored value
uniform float outputScale;  // target units per cd/m²

vec3 irradiancePlace(Side side) {
  vec2 p = side.irradianceOrigin + clamp(v.chartUv * side.size, vec2(0.5), side.size - 0.5);
  return vec3(p / vec2(textureSize(irradianceMaps, 0).xy), float(side.irradianceLayer));
}
vec3 irradianceAt(Side side) { return textureLod(irradianceMaps, irradiancePlace(side), 0.0).rgb; }

#ifdef VIEW
layout(binding = 9) uniform sampler2DArray statisticMaps;  // as irradianceMaps: photons, relative error; of the nearest texel
vec2 statisticsAt(Side side) { return textureLod(statisticMaps, irradiancePlace(side), 0.0).rg; }
#endif

vec3 emittedRadiance(Material m) {
  vec3 Le = m.emissiveRoughness.rgb;
#ifdef TEXTURED
  Le *= materialTexel(emissiveTexture, m, 2).rgb;
#endif
  return Le;
}

// Lo of lobe.h, cd/m². `lobe`: rgb = Σ B·w in stored units, a = Σ C·w.
vec3 outgoingRadiance(Side side, Material m, vec3 n, vec4 lobe) {
  vec3 base = m.baseColorMetallic.rgb;
  float metallic = m.baseColorMetallic.a;
  float roughness = sqrt(materialAlpha(m));
#ifdef TEXTURED
  base *= materialTexel(baseColorTexture, m, 0).rgb;
  metallic *= materialTexel(metallicRoughnessTexture, m, 1).b;
#endif
  vec3 Le = emittedRadiance(m);
  if ((side.flags & kPresent) == 0u) return vec3(0);
  if ((side.flags & kLit) == 0u) return Le;

  float cosine = clamp(dot(n, -normalize(v.fromEye)), 0.0, 1.0);
  vec2 node = vec2(cosine, roughness) * vec2(textureSize(specularTable, 0) - 1) + 0.5;
  vec3 table = textureLod(specularTable, node / vec2(textureSize(specularTable, 0)), 0.0).rgb;
  vec3 dielectric = min(m.dielectric.x * m.specularColorFactor.rgb, vec3(1)) * m.specularColorFactor.a;
  vec3 f0 = mix(dielectric, base, metallic);  // as makeBsdf() of tracer/optics/surface.h
  float f90 = mix(m.specularColorFactor.a, 1.0, metallic);
  vec3 once = f0 * table.x + f90 * table.y;  // the coat, as coat.h
  vec3 meanFresnel = f0 + (f90 - f0) / 21.0;
  vec3 multiple = meanFresnel * meanFresnel * table.z / (1.0 - meanFresnel * (1.0 - table.z));
  vec3 more = multiple * max(0.0, 1.0 - table.x - table.y);
  vec3 rho = once + more;

  vec3 E = irradianceAt(side);
  vec3 diffuse = (base * ((1.0 - metallic) * max(0.0, 1.0 - max(rho.r, max(rho.g, rho.b)))) + more) / kPi;
#if defined(LOBE_BARSI) || defined(LOBE_SAMPLE)
  vec3 mirrored = (side.flags & kDirections) != 0u ? lobe.rgb * mapUnit : E / kPi;
#else
  vec3 mirrored = (side.flags & kDirections) != 0u && lobe.a > 0.0 ? lobe.rgb * (mapUnit / lobe.a) : E / kPi;
#endif
  return Le + diffuse * E + once * mirrored;
}
