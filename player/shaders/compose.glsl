
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

// Of all directions of a side: rgb = Σ B·w in stored units, a = Σ C·w.
struct LightSums {
  vec4 lobe;    // w: lobeWeight()
  vec4 relief;  // w: reliefWeight(); only with a normal map
};

// What the coat does at this angle: albedo after one bounce among its facets, and after more (coat.h).
struct CoatSums {
  vec3 once, more;
};

CoatSums coatOf(Material m, vec3 base, float metallic, vec3 n) {
  float roughness = sqrt(materialAlpha(m)), cosine = clamp(dot(n, -normalize(v.fromEye)), 0.0, 1.0);
  vec2 node = vec2(cosine, roughness) * vec2(textureSize(specularTable, 0) - 1) + 0.5;
  vec3 table = textureLod(specularTable, node / vec2(textureSize(specularTable, 0)), 0.0).rgb;
  vec3 dielectric = min(m.more.x * m.specularColorFactor.rgb, vec3(1)) * m.specularColorFactor.a;
  vec3 f0 = mix(dielectric, base, metallic);  // as makeBsdf() of tracer/optics/surface.h
  float f90 = mix(m.specularColorFactor.a, 1.0, metallic);
  vec3 once = f0 * table.x + f90 * table.y;
  vec3 meanFresnel = f0 + (f90 - f0) / 21.0;
  vec3 multiple = meanFresnel * meanFresnel * table.z / (1.0 - meanFresnel * (1.0 - table.z));
  return CoatSums(once, multiple * max(0.0, 1.0 - table.x - table.y));
}

vec3 baseColorOf(Material m) {
#ifdef TEXTURED
  return m.baseColorMetallic.rgb * materialTexel(baseColorTexture, m, 0).rgb;
#else
  return m.baseColorMetallic.rgb;
#endif
}

float metallicOf(Material m) {
#ifdef TEXTURED
  return m.baseColorMetallic.a * materialTexel(metallicRoughnessTexture, m, 1).b;
#else
  return m.baseColorMetallic.a;
#endif
}

float glassShare(Material m, float metallic) { return (1.0 - metallic) * m.offset[0].w; }  // as that of tracer/optics

// Irradiance under a normal map: E of the maps, weighed by direction so that constant light stays as it is.
vec3 receivedLight(Side side, LightSums sums) {
  vec3 E = irradianceAt(side);
#ifdef RELIEF
  if ((side.flags & kDirections) != 0u && sums.relief.a > 0.0) E = sums.relief.rgb * (mapUnit * kPi / sums.relief.a);
#endif
  return E;
}

// Lo of lobe.h, cd/m². Of glass: what it emits and reflects; what is seen through it comes on top.
vec3 outgoingRadiance(Side side, Material m, vec3 n, LightSums sums) {
  vec3 base = baseColorOf(m), Le = emittedRadiance(m);
  float metallic = metallicOf(m);
#ifdef LAMBERT
  CoatSums coat = CoatSums(vec3(0), vec3(0));
#else
  CoatSums coat = coatOf(m, base, metallic, n);
#endif
  if ((side.flags & kPresent) == 0u) return vec3(0);
  if ((side.flags & kLit) == 0u) return Le;

  vec3 rho = coat.once + coat.more;
  vec3 E = receivedLight(side, sums);
  vec3 diffuse = base * ((1.0 - metallic) * max(0.0, 1.0 - max(rho.r, max(rho.g, rho.b))));
#ifdef CLEAR
  diffuse *= 1.0 - m.offset[0].w;
#endif
  vec3 matte = (diffuse + coat.more) / kPi * E;
#ifdef LAMBERT
  return Le + matte;
#else
#if defined(LOBE_BARSI) || defined(LOBE_SAMPLE)
  vec3 mirrored = (side.flags & kDirections) != 0u ? sums.lobe.rgb * mapUnit : E / kPi;
#else
  vec3 mirrored =
      (side.flags & kDirections) != 0u && sums.lobe.a > 0.0 ? sums.lobe.rgb * (mapUnit / sums.lobe.a) : E / kPi;
#endif
  return Le + matte + coat.once * mirrored;
#endif
}

#ifdef CLEAR
// Share of what lies behind that comes through, unbent.
vec3 transmitted(Material m, vec3 n) {
  vec3 base = baseColorOf(m);
  float metallic = metallicOf(m);
  CoatSums coat = coatOf(m, base, metallic, n);
  vec3 rho = coat.once + coat.more;
  return glassShare(m, metallic) * base * (1.0 - max(rho.r, max(rho.g, rho.b)));
}
#endif
