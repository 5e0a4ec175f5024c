#include "common/design/design.hpp"
#include "common/mission/mission.hpp"
#include <chrono>
#include <cstdio>
#include <cmath>
using namespace gyre;
design::Requirements regular(int n, double v){
  design::Requirements r; auto& p=r.given; p.load.mass_kg=2.0*n; p.load.inertia_b_kg_m2=Eigen::Vector3d(1,1,2).asDiagonal(); p.cable={1e4,1e3,true};
  for(int i=0;i<n;++i){ mechanics::Carrier c; c.id=i+1; c.attachment_b_m={std::cos(2*M_PI*i/n),std::sin(2*M_PI*i/n),0.3}; p.carriers.push_back(c);} 
  r.open.rate=r.open.order=true; r.open.laws.assign(n,{true,true,true,true}); p.limits.speed_min_m_s=v; p.limits.clearance_min_m=0.5; p.cycle.rate_rad_s=1; return r;}
int main(int argc,char**argv){
  int n=argc>1?atoi(argv[1]):3; double v=argc>2?atof(argv[2]):1.5;
  design::Requirements r=regular(n,v); 
  if(argc>3) { r.open.order=false; int st=atoi(argv[3]); r.open.edges.assign(n,{true,true,true}); int k=0; for(int j=0;j<n;++j){ r.given.cycle.edges.push_back({CarrierId(k+1),CarrierId((k+st)%n+1),0,0,0}); k=(k+st)%n; } }
  if(n==0){ auto m=mission::read_mission_file("deploy/missions/paper.textproto"); r={}; r.given=m.value().plan; for(auto&e:r.given.cycle.edges){(void)e;} r.open.laws.assign(4,{}); r.open.edges.assign(4,{argc>2&&v>0,true,true}); r.want.objective=design::Objective::kGreatestSpeed; r.want.amplitude_max_n=1.2; r.given.limits.winch_rate_max_m_s=0.0095;}
  auto t0=std::chrono::steady_clock::now(); std::string last; int steps=0;
  auto el=[&]{return std::chrono::duration<double>(std::chrono::steady_clock::now()-t0).count();};
  auto d=design::design(r,1,[&](const design::Progress& p){ ++steps; if(p.doing!=last){ printf("%.2f s %s best %g\n",el(),p.doing.c_str(),p.best.value_or(-1)); last=p.doing;} return el()<120; });
  printf("%.2f s, %d steps, figure %g plan %d\n",el(),steps,d.figure,(int)d.plan.has_value());
  for(auto&x:d.certificate.reasons) printf("%s: %s\n",mechanics::name(x.rule),x.text.c_str());
  for(auto&c:d.certificate.carriers) printf("  T %.3f..%.3f l %.3f..%.3f wr %.4f v %.6f..%.6f (spread %.2g) a %.3f qz %.3f\n",c.tension_n.min,c.tension_n.max,c.length_m.min,c.length_m.max,c.winch_rate_max_m_s(),c.speed_m_s.min,c.speed_m_s.max,c.speed_m_s.max-c.speed_m_s.min,c.acceleration_max_m_s2,c.vertical_cosine.min);
  if(d.plan) { auto&p=*d.plan; printf("rate %g\n",p.cycle.rate_rad_s); for(auto&e:p.cycle.edges) printf("  %u->%u off %.3f a %.3f ph %.3f\n",e.from,e.to,e.offset_n,e.amplitude_n,e.phase_rad); for(auto&c:p.carriers) printf(" h %.3f",c.law.profile.mean); puts(""); if(d.certificate.separation) printf("sep %.3f\n",d.certificate.separation->min_m);}
}
