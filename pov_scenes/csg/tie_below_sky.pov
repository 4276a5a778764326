// A sphere for the sky, whose box has more than a volume of 2e10, is unbounded to POV-Ray: it decides which of two flush
// fronts shows.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 30, -120> look_at <0, 0, -60> angle 40 }
light_source { <100, 200, -200> 1 }
sphere { <0, -10000, -200>, 15000 pigment { rgb <0.5, 0.6, 0.9> } finish { ambient 1 diffuse 0 } }
difference {
  box { <-45, -18, -60>, <45, 2, 60> }
  box { <-35, -20, -50>, <35, 4, 50> }
  pigment { rgb <0.1, 0.4, 0.5> }
}
union {
  box { <-6, 1, -60>, <6, 3, 0> }
  box { <-6, -1, -32>, <6, 3, -28> }
  pigment { rgb <0.7, 0.3, 0.1> }
}
sphere { 0, 1 scale <30, 20, 25> translate <-70, 0, 110> pigment { rgb <0.2, 0.7, 0.1> } }
