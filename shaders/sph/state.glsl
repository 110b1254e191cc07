// Pressure of a density, over the density squared. Negative pressure counts as 0: free surfaces do
// not pull. None where pressure is solved for. Sources: notes 10.4 (linear); Monaghan 1994 (Tait).

float pressure_over_density_squared(SphConstants c, float density) {
  if (c.stiff == 0u) return 0.0;
  precise const float ratio = density / c.rest_density;
  precise const float cube = ratio * ratio * ratio;
  precise const float excess = c.tait != 0u ? (cube * cube * ratio - 1.0) / 7.0 : ratio - 1.0;
  precise const float pressure = c.sound_speed * c.sound_speed * c.rest_density * max(excess, 0.0);
  precise const float result = pressure / (density * density);
  return result;
}
