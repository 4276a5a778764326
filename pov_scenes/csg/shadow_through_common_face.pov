// Two subtracted boxes share a face, which leaves a hole; shadow rays that start one unit before it pass, too.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <30, 5, 0> look_at <-70, 5, 0> angle 60 }
light_source { <10, 20, 0> rgb 1 }
difference {
  box { <-71, -18, -71>, <71, 60, 71> pigment { rgb 1 } }
  box { <-70, -10, -70>, <70, 54, 70> pigment { rgb <1, 0.2, 0.2> } }
  box { <-70, -5, -20>, <-50, 20, 20> pigment { rgb <0.2, 0.3, 1> } }
}
