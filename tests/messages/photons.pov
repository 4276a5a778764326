// mistake in line 2: a word that is not built yet, and an object asks for it
global_settings { photons { count 1000 } }
sphere { 0, 1 photons { target refraction on } }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
