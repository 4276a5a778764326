// mistake in line 2: a dash and a minus sign of a text
sphere { <0, –1, −2>, 1 }
camera { location -5*z look_at 0 }
light_source { <4, 6, -8>, rgb 1 }
