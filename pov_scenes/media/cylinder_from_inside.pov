// Media: rays that leave a cylindrical beam behind its light are dark, seen against the beam and mirrored into it.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 0, 0> look_at <0.1, 0.2, 1> angle 60 }
background { rgb 0.2 }
light_source { <0, 0, 7> rgb 6 cylinder point_at <0.1, 0, 0> radius 0.8 falloff 1.5 tightness 0 }
box {
  <-9, -9, -3>, <9, 9, 9> hollow
  pigment { rgbt 1 } finish { ambient 0 diffuse 0 }
  interior { media { scattering { 1, 0.2 extinction 0 } samples 5 } }
}
sphere { <1.6, 0.3, 6>, 0.8 pigment { rgb 0.1 } finish { reflection 0.8 } }
