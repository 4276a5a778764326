// Photons in a medium that leave the beam of their spotlight by mirrors and cross others: rounding decides whether a rest
// of the segment without samples is left, which makes a photon black.
// size: 88x66
#version 3.7;
global_settings { assumed_gamma 1 photons { spacing 0.06 media 60, 1 } }
camera { location <0,5,-5> look_at <0,0.8,0> angle 39 }
light_source { <1,8,3>, <1.2,1,0.8> spotlight radius 6 falloff 8 point_at <0,1,0> photons { refraction on reflection on } }
light_source { <-5,1.3,0.7>, <0.2,0.3,0.5> spotlight radius 5 falloff 12 point_at <0.1,0.87,0.03> photons { refraction off reflection off } }
light_source { <2,0.6,-5>, <0.4,0.2,0.1> cylinder radius 0.3 falloff 0.6 point_at <0.1,0.87,0.03> photons { refraction off reflection off } }
#default { finish { ambient 0 diffuse 0.7 } }
plane { y, -1 pigment { rgb 1 } }
box { <-1.2,0,-1.2>, <1.2,2,1.2> hollow pigment { rgbt 1 } photons { target } interior { media { scattering { 1, 0.15 extinction 0.3 } method 3 samples 8 intervals 1 } } }
box { <-0.5,-0.05,-0.5>, <0.5,0.05,0.5> pigment { rgbt <0.8,1,0.6,0.4> } finish { reflection 0.5 } rotate <40,20,10> translate <0.1,0.9,0> }
